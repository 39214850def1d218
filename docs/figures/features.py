#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fills the last column of the tables of docs/features.md with the tests that are marked as the
proof of a row: a line `Feature: ROW` in a comment above a test, or at the top of a file of tests.
With --check it only compares. A row without a test, or a mark without a row, is an error."""
import collections
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
MARK = re.compile(r"\s*(?://|#) Feature: (.+)")
NO_CODE = re.compile(r"\s*(?://|# |@)")
TEST = re.compile(r"\s*(?:TEST(?:_F|_P)?\(\s*(?P<suite>\w+),\s*(?P<name>\w+)\)|def (?P<function>test_\w+)\()")


def marks(text, file):
    """The marks of a file as (feature, name of the test below it; `file` if there is none)."""
    lines = text.splitlines()
    for number, line in enumerate(lines):
        if mark := MARK.fullmatch(line):
            rest = [other for other in lines[number + 1:] if not NO_CODE.match(other)]
            test = TEST.match(" ".join(rest[:2]))
            yield mark[1], (test["function"] or f"{test['suite']}.{test['name']}") if test else file


def proofs(tests):
    """The tests of each feature, in the order of the files and of their lines."""
    found = collections.defaultdict(list)
    for file in sorted(tests.rglob("*")):
        if file.suffix in (".cpp", ".py", ".sh"):
            for feature, name in marks(file.read_text(), file.relative_to(tests).as_posix()):
                found[feature].append(name)
    return found


def filled(page, tests):
    """`page` with the `tests` of each feature; ValueError names what does not fit."""
    features, lines = set(), []
    for line in page.splitlines():
        cells = line.strip("|").split(" | ")
        feature = cells[0].strip()
        if line.startswith("| ") and feature not in ("feature", "---"):
            if feature in features:
                raise ValueError(f"{feature}: listed twice")
            if feature not in tests:
                raise ValueError(f"{feature}: no test has this mark")
            features.add(feature)
            names = ", ".join(f"`{name}`" for name in tests[feature])
            line = "|" + " | ".join([*cells[:-1], names]) + " |"
        lines.append(line)
    if unknown := set(tests) - features:
        raise ValueError(f"marks of tests that have no row: {', '.join(sorted(unknown))}")
    return "\n".join(lines) + "\n"


def main():
    page = ROOT / "docs/features.md"
    try:
        text = filled(page.read_text(), proofs(ROOT / "tests"))
    except ValueError as error:
        sys.exit(f"{page.name}: {error}")
    if "--check" not in sys.argv:
        page.write_text(text)
    elif text != page.read_text():
        sys.exit("docs/features.md is out of date: run docs/figures/features.py")


if __name__ == "__main__":
    main()
