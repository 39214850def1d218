#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The model of docs/appendix/scaling.md: how long an archive takes on a number of processors.

usage: scaling.py [--NAME VALUE...]
Prints the tables of the page. Every number that goes in is an option.
"""
import argparse
import math

INPUTS = (
    # name, default, unit, meaning
    ("hours", 1000, "h", "length of the archive"),
    ("recordings", 1000, "", "recordings in it"),
    ("rate", 30, "pairs/s", "frame rate"),
    ("pair", 0.031, "s", "time of a pair on one processor"),
    ("start", 1.6, "s", "start and end of a task: scheduler, process, GStreamer, first frame"),
    ("length", 18000, "pairs", "length of a task"),
    ("bytes-in", 12, "KB", "size of a pair in the recordings"),
    ("bytes-out", 110, "KB", "size of a pair in the results"),
    ("storage", 1000, "MB/s", "bandwidth of the storage that all machines share"),
    ("prepare", 1.6, "s", "plan: time of a recording, for the correction of its views"),
    ("index", 941, "MB/s", "plan: speed at which one process reads recordings"),
    ("plan-jobs", 4, "", "plan: recordings that are prepared at the same time"),
    ("merge", 293, "MB/s", "merge: speed at which one process checks and joins results"),
    ("merge-jobs", 8, "", "merge: recordings that are joined at the same time"),
)
# The merge reads pieces to check them, and reads and writes them to join them.
PASSES_OF_PIECES = 3
# A recording of one task is checked and linked.
PASSES_OF_WHOLE = 1
PROCESSORS = (1, 2, 4, 16, 64, 128, 256, 512, 1024)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    for name, default, unit, meaning in INPUTS:
        parser.add_argument(f"--{name}", type=float, default=default, metavar=unit or "N",
                            help=f"{meaning} (default {default})")
    return parser.parse_args()


def hours(processors, passes, inputs):
    """Hours of plan, tasks and merge with this number of processors, one for each task."""
    pairs = inputs.hours * 3600 * inputs.rate
    storage = inputs.storage * 1000  # [KB/s]
    plan = (inputs.recordings * inputs.prepare / inputs.plan_jobs +
            pairs * inputs.bytes_in / min(storage, inputs.index * 1000 * inputs.plan_jobs))
    tasks = math.ceil(pairs / inputs.length)
    # If the storage cannot feed all processors, a pair takes as long as its bytes.
    pair = max(inputs.pair, min(processors, tasks) * (inputs.bytes_in + inputs.bytes_out) / storage)
    work = math.ceil(tasks / processors) * (inputs.start + inputs.length * pair)
    merge = pairs * inputs.bytes_out * max(passes / storage,
                                           1 / (inputs.merge * 1000 * inputs.merge_jobs))
    return tuple(seconds / 3600 for seconds in (plan, work, merge))


def figure(value):
    return f"{value:.0f}" if value >= 100 else f"{value:.3g}"


def print_inputs(inputs):
    print("| number | value |\n| --- | --- |")
    for name, _, unit, meaning in INPUTS:
        value = getattr(inputs, name.replace("-", "_"))
        print(f"| {meaning} | {value:g}{' ' + unit if unit else ''} |")


def print_hours(passes, inputs):
    print("| processors | plan, h | tasks, h | merge, h | all, h | pairs/s | relative | of ideal |\n"
          "| --- | --- | --- | --- | --- | --- | --- | --- |")
    pairs = inputs.hours * 3600 * inputs.rate
    one = sum(hours(1, passes, inputs))
    for processors in PROCESSORS:
        parts = hours(processors, passes, inputs)
        whole = sum(parts)
        print(f"| {processors} | {' | '.join(figure(part) for part in parts)} | {figure(whole)} | "
              f"{pairs / whole / 3600:.0f} | {one / whole:.3g} | {100 * one / whole / processors:.0f} % |")


def main():
    inputs = arguments()
    print_inputs(inputs)
    print("\nRecordings of several tasks:\n")
    print_hours(PASSES_OF_PIECES, inputs)
    print("\nRecordings of one task each, of the same length:\n")
    print_hours(PASSES_OF_WHOLE, inputs)


if __name__ == "__main__":
    main()
