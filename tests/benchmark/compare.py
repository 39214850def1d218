#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Compares two results of mtstereo-benchmark: medians of the time [ms] and peaks of memory [MiB].

The results are the files of --benchmark_out. The exit status is 1 if a ratio exceeds the threshold,
or if a benchmark failed or is missing in the second file, and 2 if the files cannot be compared.
"""
import argparse
import json
import pathlib
import statistics
import sys

MILLISECONDS = {"ns": 1e-6, "us": 1e-3, "ms": 1.0, "s": 1e3}
MEMORY = "peak_MiB"


class InputError(Exception):
    """A file that is not a result; the message names it."""


def figures_of(entry):
    """Name and value of each figure of an entry."""
    name = entry["run_name"]
    yield f"{name} [ms]", entry["real_time"] * MILLISECONDS[entry["time_unit"]]
    if MEMORY in entry:
        yield f"{name} [MiB]", entry[MEMORY]


def read_result(file):
    """The median of each figure, by name, and the errors of the benchmarks that failed."""
    repetitions, medians, errors = {}, {}, []
    try:
        entries = json.loads(pathlib.Path(file).read_text(encoding="utf-8"))["benchmarks"]
        for entry in entries:
            if entry.get("error_occurred"):
                errors.append(f"{entry['name']}: {entry['error_message']}")
            elif entry["run_type"] == "iteration":
                for name, value in figures_of(entry):
                    repetitions.setdefault(name, []).append(float(value))
            elif entry["aggregate_name"] == "median":
                medians.update((name, float(value)) for name, value in figures_of(entry))
    except OSError as error:
        raise InputError(f"{file}: cannot be read: {error.strerror}") from error
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise InputError(f"{file}: is not a result of mtstereo-benchmark with "
                         f"--benchmark_out={file}: {error!r}") from error
    figures = {name: statistics.median(values) for name, values in repetitions.items()}
    return {**figures, **medians}, errors


def print_table(rows):
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    for row in rows:
        fields = [row[0].ljust(widths[0])]
        fields += [field.rjust(width) for field, width in zip(row[1:], widths[1:])]
        print("  ".join(fields).rstrip())


def compare(before, after, threshold):
    """Prints the table and returns one sentence per regression."""
    rows, wrong = [("name", "before", "after", "ratio")], []
    for name, old in before.items():
        if name not in after:
            rows.append((name, f"{old:.3f}", "-", "-"))
            wrong.append(f"{name}: is missing in the second file")
            continue
        new = after[name]
        ratio = new / old if old > 0 else float("inf") if new > 0 else 1.0
        rows.append((name, f"{old:.3f}", f"{new:.3f}", f"{ratio:.3f}"))
        if ratio > threshold:
            wrong.append(f"{name}: {ratio:.3f} times as much, above the threshold {threshold:g}")
    rows += [(name, "-", f"{new:.3f}", "-") for name, new in after.items() if name not in before]
    print_table(rows)
    return wrong


def positive(text):
    value = float(text)
    if not 0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"{text} is not a ratio above 0")
    return value


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("before", help="result of the older build")
    parser.add_argument("after", help="result of the newer build")
    parser.add_argument("--threshold", type=positive, default=1.1, metavar="RATIO",
                        help="largest accepted ratio after / before (default: %(default)s)")
    options = parser.parse_args()
    try:
        before, errors_before = read_result(options.before)
        after, errors_after = read_result(options.after)
        if not before.keys() & after.keys():
            raise InputError(f"{options.before} and {options.after} have no benchmark in common")
    except InputError as error:
        print(f"compare.py: {error}", file=sys.stderr)
        return 2
    wrong = [f"before: {error}" for error in errors_before]
    wrong += [f"after: {error}" for error in errors_after]
    wrong += compare(before, after, options.threshold)
    for sentence in wrong:
        print(f"compare.py: {sentence}", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
