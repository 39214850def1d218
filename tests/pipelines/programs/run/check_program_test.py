#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Feature: check of a recording, with remedies
"""check_program_test.py PROGRAM RENDERER: mtstereo-run --check on rendered cameras with one fault each, on good ones, and
on inputs that cannot be checked. diagnosis_test.cpp has all arrangements that are recognized, and findings_test.cpp all
findings with their limits."""

import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM, RENDER = sys.argv[1:3]
SKIPPED = 77
GOOD, BAD = 0, 4
FRAMES = 9  # a frozen stream repeats eight
FEW = 3  # show all that does not take time to show
SIZE = "256x192"

# Two cameras of which the right one is turned by three degrees, for views of this size.
WRONG_CALIBRATION = """%YAML 1.0
---
image_size: [ 256, 192 ]
K1: { rows: 3, cols: 3, dt: d, data: [ 218, 0, 127.5, 0, 218, 95.5, 0, 0, 1 ] }
D1: { rows: 1, cols: 4, dt: d, data: [ 0, 0, 0, 0 ] }
K2: { rows: 3, cols: 3, dt: d, data: [ 218, 0, 127.5, 0, 218, 95.5, 0, 0, 1 ] }
D2: { rows: 1, cols: 4, dt: d, data: [ -0.2, 0, 0, 0 ] }
R: { rows: 3, cols: 3, dt: d, data: [ 1, 0, 0, 0, 0.99863, -0.05234, 0, 0.05234, 0.99863 ] }
T: { rows: 3, cols: 1, dt: d, data: [ -0.1, 0, 0 ] }
"""


def call(*arguments):
    return subprocess.run(
        [PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=120, check=False
    )


class Checks(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory(prefix="mtstereo-check-")
        cls.addClassCleanup(cls.temporary.cleanup)
        cls.folder = pathlib.Path(cls.temporary.name)
        cls.left, cls.right = cls.render("garden")
        cls.long_left, cls.long_right = cls.render("garden", frames=FRAMES)

    @classmethod
    def render(cls, scene, *options, frames=FEW):
        clip = cls.folder / (scene + str(frames) + "".join(options))
        subprocess.run([RENDER, clip, "--scene", scene, "--size", SIZE, "--frames", str(frames)]
                       + ["--samples", "1", *options], check=True, capture_output=True)
        (clip / "calib.txt").unlink()  # the views are taken as they are
        return clip / "left", clip / "right"

    def altered(self, view, *filters):
        """A copy of a view, changed by filters of ffmpeg."""
        folder = self.folder / f"{self.id().rsplit('.', 1)[1]}-{view.parent.name}-{view.name}"
        folder.mkdir()
        subprocess.run(["ffmpeg", "-v", "error", "-start_number", "0", "-i", view / "%06d.png"]
                       + ["-vf", ",".join(filters), "-start_number", "0", folder / "%06d.png"],
                       check=True, stdin=subprocess.DEVNULL)
        return folder

    def chosen(self, view, numbers):
        """Some frames of a view, as a view."""
        folder = self.folder / f"{self.id().rsplit('.', 1)[1]}-{view.name}-{numbers[0]}"
        folder.mkdir()
        for i, number in enumerate(numbers):
            (folder / f"{i:06d}.png").symlink_to(view / f"{number:06d}.png")
        return folder

    def check(self, status, pattern, *arguments):
        result = call("--check", *arguments)
        self.assertEqual(result.returncode, status, result.stdout + result.stderr)
        self.assertRegex(" ".join(result.stdout.split()), pattern)
        return result.stdout

    def test_good_views_are_good(self):
        page = self.check(GOOD, r"Result: good\.$", self.long_left, self.long_right)
        self.assertNotRegex(page, "HARM|note")
        for line in ("views", "rows", "time", "light", "sharpness", "disparities", "sparse", "semi-dense", "dense"):
            self.assertRegex(page, rf"(?m)^  {line} ")
        density = float(page.split("semi-dense")[1].split()[0])
        self.assertTrue(40 < density < 95, page)
        self.assertLessEqual(max(map(len, page.splitlines())), 100)

    def test_both_views_in_one_frame_are_good(self):
        both = self.folder / "both"
        both.mkdir()
        subprocess.run(["ffmpeg", "-v", "error", "-i", self.left / "%06d.png", "-i", self.right / "%06d.png"]
                       + ["-filter_complex", "hstack", both / "%06d.png"], check=True, stdin=subprocess.DEVNULL)
        self.check(GOOD, r"not measured: both views are in one frame.*Result: good\.$", both)

    def test_exchanged_views(self):
        self.check(BAD, r"HARM The left and the right view are exchanged.*> --swap", self.right, self.left)
        self.check(GOOD, "Result: good", self.right, self.left, "--swap")

    def test_views_of_different_times(self):
        left = self.chosen(self.long_left, range(0, FRAMES - 2))
        right = self.chosen(self.long_right, range(2, FRAMES))
        self.check(BAD, r"HARM The two views were not taken at the same time: with the right view 2 frames "
                   r"earlier.*That is about 67 ms\. > --sync auto", left, right)

    def test_rows_that_can_be_corrected(self):
        left = self.altered(self.left, "crop=iw:ih-6:0:3")
        right = self.altered(self.right, "crop=iw:ih-6:0:0")
        page = self.check(GOOD, r"note The rows of the right view are 3\.0 px lower: alignment=correct.*"
                          r"rows the right view is 3\.0 px lower, corrected", left, right)
        self.assertIn("Result: good, 1 note.", page)
        self.check(BAD, r"HARM The rows .* are not corrected\. > Set --alignment correct",
                   left, right, "--alignment", "off")

    def test_rows_that_are_too_far_off(self):
        left = self.altered(self.left, "crop=iw:ih-20:0:12")
        right = self.altered(self.right, "crop=iw:ih-20:0:0")
        self.check(BAD, r"HARM The views are not rectified: the rows of the same points differ by \+1[12]\.\d "
                   r"to \+12\.\d px\. > Give the calibration", left, right)

    def test_a_calibration_of_other_cameras(self):
        calibration = self.folder / "wrong.yml"
        calibration.write_text(WRONG_CALIBRATION)
        self.check(BAD, r"HARM The calibration \S+wrong\.yml does not fit these views",
                   self.left, self.right, "--calibration", calibration)

    def test_exposures_that_differ(self):
        page = self.check(GOOD, r"note The exposure differs: the mean gray values are \d+ \(left\) and \d+ \(right\)",
                          self.left, self.altered(self.right, "lutyuv=y=val*0.5"))
        self.assertNotIn("HARM", page)

    def test_a_soft_view(self):
        self.check(BAD, r"HARM The right view is less sharp: the other one has \d\.\d times",
                   self.left, self.altered(self.right, "gblur=sigma=3"))

    def test_soft_views(self):
        soft = ["scale=iw/2:ih/2", "scale=iw*2:ih*2:flags=bicubic"]
        page = self.check(GOOD, r"note The views are soft: their finest detail is 0\.0\d.*> .*resolution=half-refined",
                          self.altered(self.left, *soft), self.altered(self.right, *soft))
        self.assertNotIn("HARM", page)

    def test_dark_views(self):
        self.check(BAD, r"HARM Dark: 95 % of the pixels are below \d+ \(left\) and \d+ \(right\)",
                   *self.render("garden", "--light", "0.08", "--noise", "2"))

    def test_white_views(self):
        white = "lutrgb=" + ":".join(f"{channel}=min(val*2.5\\,255)" for channel in "rgb")
        self.check(GOOD, "note White, without texture: 3[0-9] % of the left and 3[0-9] % of the right view",
                   self.altered(self.left, white), self.altered(self.right, white))

    def test_a_range_that_is_too_small_or_too_large(self):
        page = self.check(BAD, r"HARM The search range is too small.*> Set max-disparity=\d+",
                          self.left, self.right, "--max-disparity", 9)
        needed = int(page.split("> Set max-disparity=")[1].split(".")[0])
        self.check(GOOD, "Result: good", self.left, self.right, "--max-disparity", needed)
        self.check(GOOD, f"takes more time than needed. > Set max-disparity={needed}",
                   self.left, self.right, "--max-disparity", 3 * needed)

    def test_the_same_view_twice(self):
        copy = self.altered(self.left, "null")
        self.check(BAD, "HARM Both views are the same image", self.left, copy)

    def test_a_covered_lens_and_a_frozen_stream(self):
        black = self.altered(self.right, "lutyuv=y=16:u=128:v=128")
        self.check(BAD, r"HARM The right view shows nothing\. > Check whether its lens", self.left, black)
        frozen = self.chosen(self.long_right, [0] * FRAMES)
        page = self.check(BAD, "HARM The right view repeats itself", self.long_left, frozen)
        self.assertIn("1 harmful finding.", page)

    def test_one_pair_and_two_pairs(self):
        for count in (1, 2):
            left, right = (self.chosen(view, range(count)) for view in (self.left, self.right))
            self.check(GOOD, rf"{count} pairs?, .*not measured: .*Result: good", left, right)
            shutil.rmtree(left), shutil.rmtree(right)

    def test_tiny_views(self):
        left, right = (self.altered(view, "scale=48:36") for view in (self.left, self.right))
        self.check(GOOD, "note The views are too small to check", left, right)

    def test_writes_only_its_own_image(self):
        out = self.folder / "out"
        command = ["--check", self.left, self.right, "--out", out]
        for _ in range(2):
            self.assertEqual(call(*command).returncode, GOOD)
        self.assertTrue((out / "rows.png").read_bytes().startswith(b"\x89PNG"))
        self.assertEqual(sorted(path.name for path in out.iterdir()), [".mtstereo-check-files", "rows.png"])
        (out / "rows.png").write_text("mine")
        result = call(*command)
        self.assertEqual(result.returncode, 1)
        self.assertIn("rows.png was changed since it was written", result.stderr)
        self.assertEqual((out / "rows.png").read_text(), "mine")
        self.assertEqual(result.stdout, "")

    def test_without_out_nothing_is_written(self):
        before = sorted(self.left.parent.rglob("*"))
        self.check(GOOD, "good", self.left.parent)
        self.assertEqual(sorted(self.left.parent.rglob("*")), before)

    def test_inputs_that_cannot_be_checked(self):
        empty = self.folder / "empty"
        empty.mkdir()
        single = self.left / "000000.png"
        for arguments, text in (
            ([self.left, self.folder / "missing.mp4"], "missing.mp4: no such file"),
            ([single], "is the shape of one view"),
            ([self.left, self.left], "are the same file"),
            ([empty], "neither images nor one video|no recording"),
            ([self.left, empty], "neither images nor one video"),
            ([self.left, self.right, "--calibration", self.folder / "no.yml"], "no.yml"),
            ([self.left, self.right, "--calibration", single], "000000.png"),
        ):
            result = call("--check", *arguments)
            self.assertEqual(result.returncode, 1, result.stderr)
            self.assertRegex(result.stderr, text)
            self.assertEqual(result.stdout, "")

    def test_options_that_exclude_it(self):
        for option in ("--resume", "--overwrite", "--list", "--jobs=2"):
            self.assertEqual(call("--check", self.left, self.right, option).returncode, 2)
        self.assertEqual(call("plan", self.left, "--out", self.folder / "plan", "--check").returncode, 2)

    def test_all_recordings_of_a_folder(self):
        archive = self.folder / "archive"
        for name, left, right in (("bad", self.right, self.left), ("good", self.left, self.right)):
            (archive / name).mkdir(parents=True)
            (archive / name / "left").symlink_to(left)
            (archive / name / "right").symlink_to(right)
        page = self.check(BAD, r"bad: .*Result: bad, 1 harmful finding\. good: .*Result: good\.$", archive)
        self.assertEqual(page.count("Measured"), 2)


if __name__ == "__main__":
    del sys.argv[1:3]
    if shutil.which("ffmpeg") is None:
        print("ffmpeg is not installed")
        sys.exit(SKIPPED)
    unittest.main()
