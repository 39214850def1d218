#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The programs of docs/python.md run, and give what the page states."""
import os
import re
import shutil
import sys
import unittest

from support import CALIBRATION, FRAMES, SOURCE, ClipTest, require, run

PAGE = SOURCE / "docs/python.md"
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)

if "MODULE_FOLDER" not in os.environ:
    print("skipped: the Python module is not built (option python), or NumPy is missing")
    sys.exit(77)
os.environ["PYTHONPATH"] = os.environ["MODULE_FOLDER"]
PYTHON = os.environ["MODULE_PYTHON"]

# Appended to the first program: the images have the disparities.
CHECK_OF_IMAGES = """
stored = cv2.imread("disparity.png", cv2.IMREAD_UNCHANGED)
assert np.array_equal(np.where(stored > 0, stored / 256, np.nan).astype("f4"), result.disparity, equal_nan=True)
assert np.array_equal(cv2.imread("confidence.png", cv2.IMREAD_UNCHANGED), result.confidence)
"""


def programs():
    return [text for name, text in BLOCK.findall(PAGE.read_text()) if name == "python"]


class PythonPage(ClipTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        for side in ("left", "right"):
            shutil.copy(cls.folder / side / "000000.png", cls.folder / f"{side}.png")
        (cls.folder / "stereo.yaml").write_text(CALIBRATION)

    def need(self, statement, packages):
        if run([PYTHON, "-c", statement], self.folder).status != 0:
            self.skipTest(f"a Python module is missing ({packages})")

    def run_program(self, text, *arguments):
        (self.folder / "program.py").write_text(text)
        return run([PYTHON, "program.py", *arguments], self.folder, 120)

    def test_images_become_disparities(self):
        self.need("import cv2", "python3-opencv")
        done = require(self.run_program(programs()[0] + CHECK_OF_IMAGES, "left.png", "right.png", "48"))
        self.assertRegex(done.output, r"^density [1-9]\d\.\d %, median \d+\.\d\d px\n$")
        missing = self.run_program(programs()[0], "no.png", "right.png", "48")
        self.assertEqual((missing.status, missing.errors.splitlines()[-1]), (1, "no.png is missing or not an image"))

    def test_raw_views_become_depths_and_points(self):
        self.need("import cv2", "python3-opencv")
        done = require(self.run_program(programs()[1], "left.png", "right.png", "stereo.yaml"))
        self.assertRegex(done.output, r"^focal length 13\d\.\d px, baseline 0\.100 m, .*\n"
                                      r"nearest \d\.\d\d m, \d{4,5} points up to \d+\.\d\d m\n$")
        self.assertTrue((self.folder / "scene.ply").read_bytes().startswith(b"ply\n"))

    # Feature: metas of the left frame are kept, and own metas can be read without headers
    def test_python_runs_and_finds_the_confidence(self):
        self.need("import gi; gi.require_version('GstApp', '1.0'); from gi.repository import GstApp",
                  "python3-gi, gir1.2-gst-plugins-base-1.0")
        done = require(self.run_program(programs()[2], "left.mp4", "right.mp4"))
        found = re.findall(r"^160x120: (\d+) % known, median ([\d.]+) px; (\d+) % with", done.output, re.MULTILINE)
        self.assertEqual(len(found), FRAMES, str(done))
        for known, median, confident in found:
            self.assertTrue(0 < int(confident) <= int(known) <= 100 and 1 < float(median) < 64, str(done))
        missing = self.run_program(programs()[2], "left.mp4", "no.mp4")
        self.assertEqual(missing.status, 1, str(missing))
        self.assertIn("RuntimeError", missing.errors)

    def test_no_program_is_left_out(self):
        self.assertEqual({name for name, _ in BLOCK.findall(PAGE.read_text())}, {"console", "python"})
        self.assertEqual(len(programs()), 3)


if __name__ == "__main__":
    unittest.main(verbosity=2)
