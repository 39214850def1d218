#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Measures, and writes the figures of docs/appendix/benchmark.md.

Runs the benchmarks of a build, or uses the results of an earlier run (--no-run). Replaces the text
between the two marks of the page. The exit status is 1 if a program fails and 2 if a result or the
page cannot be used; the page is not changed then.
"""
import argparse
import os
import pathlib
import subprocess
import sys

import tables
from compare import InputError
from results import Result

SOURCE = pathlib.Path(__file__).resolve().parents[2]
BEGIN, END = "<!-- figures: begin -->", "<!-- figures: end -->"


class RunError(Exception):
    """A failed program; the message names it."""


def run(program, *arguments, **environment):
    try:
        subprocess.run([program, *map(str, arguments)], check=True,
                       env={**os.environ, **environment})
    except (OSError, subprocess.CalledProcessError) as error:
        raise RunError(f"{program}: {error}") from error


def measure(build, result, element_result):
    """Runs both programs of the build; the second one exists only with the plugin."""
    programs = build / "tests/benchmark"
    run(programs / "mtstereo-benchmark", f"--benchmark_out={result}")
    element = programs / "mtstereo-benchmark-element"
    if element.exists():
        plugins = os.pathsep.join(filter(None, [str(build / "gst"),
                                                os.environ.get("GST_PLUGIN_PATH")]))
        run(element, f"--benchmark_out={element_result}", GST_PLUGIN_PATH=plugins)


def section(result, element_result):
    parts = [tables.machine(result, element_result), tables.frames(result), tables.stages(result),
             tables.targets(result), tables.growth(result), tables.memory(result)]
    if element_result:
        parts.append(tables.element(element_result))
    return "\n\n".join(part for part in parts if part)


def read_page(page):
    """The texts before and after the figures."""
    try:
        text = page.read_text(encoding="utf-8")
    except (OSError, ValueError) as error:
        raise InputError(f"{page}: cannot be read: {error}") from error
    if text.count(BEGIN) != 1 or text.count(END) != 1 or text.index(END) < text.index(BEGIN):
        raise InputError(f"{page}: must contain the line {BEGIN} once, and after it the line {END}")
    return text[:text.index(BEGIN)], text[text.index(END) + len(END):]


def update(options):
    before, after = read_page(options.page)
    result_file = options.result or options.build / "benchmark.json"
    element_file = options.element_result or options.build / "benchmark-element.json"
    if not options.no_run:
        element_file.unlink(missing_ok=True)  # do not use an older one if there is no plugin now
        measure(options.build, result_file, element_file)
    result = Result(result_file)
    has_element = options.element_result or element_file.exists()
    element_result = Result(element_file) if has_element else None
    try:
        text = section(result, element_result)
        doubts = tables.doubts(result)
    except (ValueError, KeyError, IndexError, TypeError, ArithmeticError) as error:
        raise InputError(f"{result_file} or {element_file}: lacks figures that the current "
                         f"programs write: {error!r}") from error
    options.page.write_text(f"{before}{BEGIN}\n\n{text}\n\n{END}{after}", encoding="utf-8")
    for doubt in doubts:
        print(f"figures.py: repeat on a quiet machine: {doubt}", file=sys.stderr)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("build", nargs="?", type=pathlib.Path, default=SOURCE / "build",
                        help="folder of the build (default: %(default)s)")
    parser.add_argument("--no-run", action="store_true",
                        help="measure nothing; use the existing results")
    parser.add_argument("--result", type=pathlib.Path,
                        help="result of mtstereo-benchmark (default: BUILD/benchmark.json)")
    parser.add_argument("--element-result", type=pathlib.Path,
                        help="result of mtstereo-benchmark-element, if any "
                             "(default: BUILD/benchmark-element.json)")
    parser.add_argument("--page", type=pathlib.Path, default=SOURCE / "docs/appendix/benchmark.md",
                        help="page to update (default: %(default)s)")
    options = parser.parse_args()
    try:
        update(options)
    except InputError as error:
        print(f"figures.py: {error}", file=sys.stderr)
        return 2
    except (RunError, OSError) as error:
        print(f"figures.py: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
