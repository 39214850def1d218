#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""demo.sh end to end on a tiny clip, with video files, and with invalid input."""
import re
import shutil
import unittest

from support import BUILD, ClipTest, SLOW, count_frames


class Demo(ClipTest):
    CLIP = ["--frames", "4", "--size", "240x180"]

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.crisp = cls.folder / "all of it"
        cls.of_crisp = cls.demo("--out", cls.crisp.name, *cls.CLIP)

    @classmethod
    def demo(cls, *words):
        return cls.run_script("demo.sh", "--no-build", "--build", BUILD, *words, seconds=120)

    # Feature: demo, scripts and documentation
    def test_creates_all_outputs(self):
        done, out = self.of_crisp, self.crisp
        self.assert_succeeds(done)
        for name in ("left.mp4", "right.mp4", "disparity-sparse.mkv", "disparity-semi-dense.mkv",
                     "disparity-dense.mkv", "disparity-full.mkv", "color.mp4", "demo.png"):
            self.assertGreater((out / name).stat().st_size, 0, name)
            self.assertIn(str(out / name), done.output)
        self.assertEqual(count_frames(out / "disparity-semi-dense.mkv", self.folder), 4)
        self.assertEqual(count_frames(out / "color.mp4", self.folder), 4)
        rows = {row.split()[0]: row.split()[1:] for row in done.output.splitlines()
                if re.match(r"(sparse|semi-dense|dense|full) +\d", row)}
        self.assertEqual(set(rows), {"sparse", "semi-dense", "dense", "full"}, done.output)
        for mode, row in rows.items():
            frames, error, outliers, density, seen_error, seen_outliers, speed = map(float, row)
            self.assertEqual(frames, 4, mode)
            self.assertTrue(0 < error < 5, f"{mode}: {row}")
            self.assertTrue(0 <= outliers < 50, f"{mode}: {row}")
            self.assertTrue(1 < density <= 100, f"{mode}: {row}")
            self.assertLessEqual(seen_error, error, f"{mode}: {row}")
            self.assertLessEqual(seen_outliers, outliers, f"{mode}: {row}")
            self.assertGreater(speed, 0, f"{mode}: {row}")
        self.assertGreater(float(rows["semi-dense"][3]), float(rows["sparse"][3]), "density")
        self.assertGreater(float(rows["dense"][3]), float(rows["semi-dense"][3]), "density")
        self.assertEqual(float(rows["full"][3]), 100, "density")

    def test_soft_cameras_are_rendered_and_compressed(self):
        done = self.demo("--soft", "--out", "soft", *self.CLIP)
        self.assert_succeeds(done)
        self.assertRegex(done.output, r"\nsemi-dense +4 ")
        for name, share in (("left.mp4", 0.2), ("right.mp4", 0.2), ("clip/left/000000.png", 0.95)):
            crisp, soft = ((out / name).stat().st_size
                           for out in (self.crisp, self.folder / "soft"))
            self.assertLess(soft, share * crisp, name)
        for name in ("truth/000001.pfm", "mask/000001.png", "calib.txt"):
            crisp, soft = ((out / "clip" / name).read_bytes()
                           for out in (self.crisp, self.folder / "soft"))
            self.assertEqual(soft, crisp, name)

    @unittest.skipIf(SLOW > 1, "40 views of a board take minutes in a sanitized build")
    def test_raw_cameras_are_calibrated_and_measure_meters(self):
        done = self.demo("--raw", "--out", "raw", "--frames", "2", "--size", "320x180",
                         "--alpha", "0.1", "--rectified-size", "301x171")
        self.assert_succeeds(done)
        out = self.folder / "raw"
        for name in ("demo.png", "color.mp4", "cameras/calibration.yml", "depth/000001.png"):
            self.assertGreater((out / name).stat().st_size, 0, name)
        rows = {row.split()[0]: row.split() for row in done.output.splitlines()
                if re.match(r" +\d+ \.\. \d+ ", row)}
        for first, limit in (("0", 1.0), ("5", 2.5)):
            density, error = float(rows[first][3]), float(rows[first][4])
            self.assertGreater(density, 60, done.output)
            self.assertLess(error, limit, done.output)

    def test_accepts_own_files(self):
        done = self.demo("left.mp4", "right.mkv", "--out", "own", "--mode", "sparse",
                         "--max-disparity", "32")
        self.assert_succeeds(done)
        self.assertEqual(count_frames(self.folder / "own/disparity-sparse.mkv", self.folder), 8)
        for name in ("color.mp4", "demo.png"):
            self.assertGreater((self.folder / "own" / name).stat().st_size, 0, name)

    def test_shows_the_elements_message_if_sizes_differ(self):
        done = self.demo("left.mp4", f"{self.crisp.name}/right.mp4", "--out", "differ")
        self.assert_rejects(done, "160x120", 1)
        self.assertIn("240x180", done.errors)

    def test_names_a_missing_file(self):
        self.assert_rejects(self.demo("left.mp4", "nothing.mp4"), "nothing.mp4", 1)

    def test_rejects_a_file_that_is_not_a_video(self):
        (self.folder / "text.mp4").write_text("this is not a video\n" * 50)
        done = self.demo("left.mp4", "text.mp4", "--out", "text")
        self.assert_rejects(done, "the pipeline failed", 1)
        self.assertIn("ERROR", done.errors)

    def test_never_overwrites_its_input(self):
        own = self.folder / "same"
        own.mkdir()
        shutil.copy(self.folder / "left.mp4", own / "color.mp4")
        before = (own / "color.mp4").read_bytes()
        done = self.demo("same/color.mp4", "right.mkv", "--out", "same")
        self.assert_rejects(done, "would be overwritten", 1)
        self.assertEqual((own / "color.mp4").read_bytes(), before)

    def test_keeps_files_of_others(self):
        foreign = self.folder / "videos"
        foreign.mkdir()
        (foreign / "left.mp4").write_bytes(b"of the user")
        self.assert_rejects(self.demo("--out", "videos"), "did not write", 1)
        self.assertEqual([each.name for each in foreign.iterdir()], ["left.mp4"])
        self.assertEqual((foreign / "left.mp4").read_bytes(), b"of the user")

    def test_names_a_folder_that_cannot_be_created(self):
        self.assert_rejects(self.demo("--out", "/dev/null/out"), "/dev/null/out", 1)

    def test_raw_takes_no_files(self):
        self.assert_rejects(self.demo("--raw", "left.mp4", "right.mp4"), "--calibration", 2)

    def test_soft_takes_no_files(self):
        self.assert_rejects(self.demo("--soft", "left.mp4", "right.mp4"), "--soft", 2)

    def test_rejects_invalid_options(self):
        for words, says in ((["left.mp4"], "two video files"),
                            (["a", "b", "c"], "two video files"),
                            (["--mode", "denser"], "--mode"),
                            (["--max-disparity", "-3"], "--max-disparity"),
                            (["--max-disparity", "5000"], "1 to 1984"),
                            (["--frames", "0"], "--frames"),
                            (["--size", "640"], "--size"),
                            (["--raw", "--alpha", "1.5"], "--alpha"),
                            (["--raw", "--rectified-size", "640"], "--rectified-size"),
                            (["--alpha", "1"], "need --raw"),
                            (["--size", "161x120"], "even"),
                            (["--out"], "--out"),
                            (["--colour", "red"], "--colour")):
            self.assert_rejects(self.demo(*words), says, 2)

    def test_rejects_an_unknown_scene(self):
        done = self.demo("--out", "moon", "--scene", "moon")
        self.assert_rejects(done, "street, garden, room", 1)

    def test_reports_a_missing_build(self):
        done = self.run_script("demo.sh", "--no-build", "--build", "nowhere", "--out", "nobuild")
        self.assert_rejects(done, "nowhere", 1)

    def test_help_lists_the_options(self):
        done = self.demo("--help")
        self.assert_succeeds(done)
        self.assertIn("--max-disparity", done.output)


if __name__ == "__main__":
    unittest.main(verbosity=2)
