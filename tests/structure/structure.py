#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Checks which files of the source tree include each other. It fails if units include each other in a
cycle, or if a room includes a private header of another room. It also fails if a test file has no namespace
of its own: several are compiled as one file.

A unit is a header with its source: what one of them includes, the unit includes.

usage: structure.py REPOSITORY
"""

import os
import re
import sys
from pathlib import Path

ROOMS = ('core', 'gst', 'pipelines')
SUFFIXES = ('-inl.hpp', '.hpp', '.cpp', '.h', '.c')
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)

# The folders that compilers search for headers, after that of the source.
SEARCHED = ('core/include', 'core', 'gst', 'pipelines')

# Headers that every room may include.
PUBLIC = ('core/include/',)

# Who else includes headers of another room, and which ones: parts are linked statically with it.
SHARED = {
    'pipelines/programs/calibrate/': ('gst/matcher/pairing/',),
    'pipelines/recordings/': ('core/alignment/', 'core/geometry/calibration_path'),
    'pipelines/tools/fit/': ('core/',),
    'pipelines/lib/outputs/': ('core/geometry/new_file',),
    'pipelines/': ('gst/shared/',),
}


def unit_of(path):
    """The path without suffix, or None for files of other kinds."""
    return next((path[:-len(suffix)] for suffix in SUFFIXES if path.endswith(suffix)), None)


def source_files(repository):
    for room in ROOMS:
        for folder, _, names in os.walk(repository / room):
            paths = (os.path.relpath(os.path.join(folder, name), repository) for name in names)
            yield from (path for path in paths if unit_of(path))


def included_file(path, name, known):
    """The file of the tree that `path` includes as `name`, or None for headers of others. The folders
    above the file are searched too, since some of them are searched folders of its target."""
    folders = [str(folder) for folder in Path(path).parents] + list(SEARCHED)
    places = (os.path.normpath(os.path.join(folder, name)) for folder in folders)
    return next((place for place in places if place in known), None)


def includes(repository):
    """Pairs of a file and a file that it includes, both in the tree."""
    known = set(source_files(repository))
    for path in sorted(known):
        for name in INCLUDE.findall((repository / path).read_text(encoding='utf-8')):
            found = included_file(path, name, known)
            if found:
                yield path, found


def reachable(graph, start):
    """The units that `start` includes, directly or through others."""
    seen, waiting = set(), list(graph.get(start, ()))
    while waiting:
        unit = waiting.pop()
        if unit not in seen:
            seen.add(unit)
            waiting += graph.get(unit, ())
    return seen


def cycles(pairs):
    """The groups of units that include each other."""
    graph = {}
    for path, included in pairs:
        units = unit_of(path), unit_of(included)
        if units[0] != units[1]:
            graph.setdefault(units[0], set()).add(units[1])
    reached = {unit: reachable(graph, unit) for unit in graph}
    groups = {tuple(sorted(other for other in reached[unit] if unit in reached.get(other, ())))
              for unit in graph if unit in reached[unit]}
    return sorted(groups)


def private_includes(pairs):
    """The pairs of which the second file is a private header of another room."""
    def allowed(path, included):
        shared = (headers for room, headers in SHARED.items() if path.startswith(room))
        return (path.split('/')[0] == included.split('/')[0] or included.startswith(PUBLIC) or
                any(included.startswith(headers) for headers in shared))
    return [pair for pair in pairs if not allowed(*pair)]


def unnamed_tests(repository):
    """The test files whose names are not in a namespace that is called like the file."""
    return [str(path.relative_to(repository)) for path in sorted((repository / 'tests').rglob('*_test.cpp'))
            if not re.search(rf'^namespace [\w:]+::{path.stem} {{$', path.read_text(encoding='utf-8'), re.MULTILINE)]


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    pairs = list(includes(Path(sys.argv[1])))
    if not pairs:
        sys.exit(f'structure.py: {sys.argv[1]} has no sources that include each other')
    problems = [f'These units include each other: {", ".join(group)}' for group in cycles(pairs)]
    problems += [f'{path} includes {included}, a private header of another room'
                 for path, included in private_includes(pairs)]
    problems += [f'{path} has no namespace {Path(path).stem}: open it as namespace mtstereo::{Path(path).stem}'
                 for path in unnamed_tests(Path(sys.argv[1]))]
    print('\n'.join(problems))
    sys.exit(1 if problems else 0)


if __name__ == '__main__':
    main()
