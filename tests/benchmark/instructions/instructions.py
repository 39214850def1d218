#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Counts the instructions of each step on 64-bit ARM under QEMU, and estimates frames per second.

BUILD is a build for ARM: meson setup BUILD --cross-file tests/cross/aarch64.txt --buildtype=release
-Dgst=disabled -Dtools=disabled. The counts are exact. The speed is an estimate, as QEMU has neither
pipelines nor caches: instructions per cycle are assumed."""
import argparse
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
# Clock [Hz] and instructions per cycle: those of the hottest loops by a model of the pipelines,
# with and without latencies, less the misses of a cache of 512 KiB.
PROCESSORS = {"Cortex-A76, 2.4 GHz (Raspberry Pi 5)": (2.4e9, 2.6, 3.2),
              "Cortex-A72, 1.8 GHz (Raspberry Pi 4)": (1.8e9, 1.7, 2.1)}


def count(program, width, height, views, parameters):
    """The instructions of a frame as (step, count), in order."""
    with tempfile.TemporaryDirectory() as folder:
        plugin = f"{folder}/plugin.so"
        subprocess.run(["g++", "-O2", "-shared", "-fPIC", HERE / "qemu_plugin.cpp", "-o", plugin], check=True)
        run = subprocess.run(["qemu-aarch64", "-plugin", plugin, program, str(width), str(height), *views,
                              *parameters], capture_output=True, text=True)
    if run.returncode != 0:
        sys.exit(run.stderr.strip())
    totals = [int(line) for line in run.stderr.split()]
    steps = run.stdout.split()
    if len(totals) != len(steps) + 1:
        sys.exit(f"{len(steps)} steps ran, but {len(totals)} counts were made: is {program} stripped?")
    return list(zip(steps, (after - before for before, after in zip(totals, totals[1:]))))


def table(counts, pixels):
    """The lines of the table, and those of the estimates."""
    total = sum(instructions for _, instructions in counts)
    for name, instructions in [*counts, ("frame", total)]:
        yield f"{name:24}{instructions / pixels:9.1f} instructions/px"
    for name, (clock, fewest, most) in PROCESSORS.items():
        yield f"{name}: {clock * fewest / total:.0f} to {clock * most / total:.0f} frames/s on one core (estimate)"


def write_gray(image, file):
    """Writes the gray values of an image, and returns its size."""
    import cv2  # only for images; the test has none
    gray = cv2.imread(str(image), cv2.IMREAD_GRAYSCALE)
    if gray is None:
        sys.exit(f"{image} is not an image that OpenCV reads")
    gray.tofile(file)
    return gray.shape[1], gray.shape[0]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, metavar="BUILD")
    parser.add_argument("left", metavar="LEFT", help="an image")
    parser.add_argument("right", metavar="RIGHT", help="an image of the same size")
    parser.add_argument("parameters", nargs="*", metavar="PARAMETER=VALUE")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        views = [f"{folder}/left", f"{folder}/right"]
        width, height = write_gray(arguments.left, views[0])
        if write_gray(arguments.right, views[1]) != (width, height):
            sys.exit("the views differ in size")
        program = arguments.build / "tests/benchmark/instructions/mtstereo-count-steps"
        counts = count(program, width, height, views, arguments.parameters)
    print("\n".join(table(counts, width * height)))


if __name__ == "__main__":
    main()
