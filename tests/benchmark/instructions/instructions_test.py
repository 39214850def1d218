#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The instructions of each step are counted under QEMU. The first argument is the program."""
import os
import pathlib
import random
import sys
import tempfile
import unittest

import instructions

PROGRAM = pathlib.Path(sys.argv.pop(1))
WIDTH, HEIGHT = 96, 40
# meson puts the cross compiler's assembler first, which the compiler of the plugin would take.
os.environ["PATH"] = os.pathsep.join(folder for folder in os.environ["PATH"].split(os.pathsep)
                                     if "aarch64" not in folder)


def count(*parameters):
    """Counts for a texture that is 7 px further left in the right view."""
    noise = random.Random(1)
    rows = [bytes(noise.randrange(256) for _ in range(WIDTH + 7)) for _ in range(HEIGHT)]
    with tempfile.TemporaryDirectory() as folder:
        views = [pathlib.Path(folder, name) for name in ("left", "right")]
        for view, first in zip(views, (0, 7)):
            view.write_bytes(b"".join(row[first:first + WIDTH] for row in rows))
        return instructions.count(PROGRAM, WIDTH, HEIGHT, views, parameters)


class Counts(unittest.TestCase):
    def test_are_of_the_steps_of_the_mode(self):
        of_mode = {mode: dict(count("max-disparity=32", f"mode={mode}")) for mode in ("semi-dense", "full")}
        self.assertIn("rejection", of_mode["semi-dense"])
        self.assertNotIn("rejection", of_mode["full"])
        self.assertIn("plane-completion", of_mode["full"])

    def test_grow_with_the_range_where_disparities_are_compared(self):
        few, many = (dict(count(f"max-disparity={range_}", "preset=paper")) for range_ in (16, 64))
        self.assertGreater(many["cost-volume"], 2 * few["cost-volume"])

    def test_are_the_same_again(self):
        self.assertEqual(count("max-disparity=32"), count("max-disparity=32"))

    def test_name_what_is_wrong(self):
        for parameter, message in (("colour=1", "colour"), ("mode", "PARAMETER=VALUE"), ("max-disparity=x", "x")):
            with self.subTest(parameter), self.assertRaisesRegex(SystemExit, message):
                count(parameter)


class Table(unittest.TestCase):
    def test_has_instructions_per_pixel_and_the_estimates(self):
        lines = list(instructions.table([("census", 3_000_000), ("matching", 5_000_000)], 10_000))
        self.assertEqual(lines[0].split(), ["census", "300.0", "instructions/px"])
        self.assertEqual(lines[2].split(), ["frame", "800.0", "instructions/px"])
        self.assertIn("780 to 960 frames/s", lines[3])


if __name__ == "__main__":
    unittest.main(verbosity=2)
