#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The programs of docs/application.md are built, run, and give what the page states."""
import re
import shutil
import subprocess
import unittest

from support import BUILD, CALIBRATION, FRAMES, SOURCE, ClipTest, require, run

PAGE = SOURCE / "docs/application.md"
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
PYTHON = "/usr/bin/python3"
FOCAL_TIMES_BASELINE = 13.6  # of the rendered room at 160 px [px m]

# Appended to the program that reads results: every format gives the same.
CHECK_OF_RESULTS = """
assert np.array_equal(values, read_frames("images/disparity/%06d.png"))
floats = np.stack([read_pfm(f"floats/disparity/{n:06d}.pfm") for n in range(len(values))])
assert np.array_equal(np.where(np.isinf(floats), np.nan, floats), disparity.astype("f4"), equal_nan=True)
meters = np.stack([read_pfm(f"floats/depth/{n:06d}.pfm") for n in range(len(values))])
known = (depth > 0) & np.isfinite(meters)
assert known.any() and np.abs(depth - meters)[known].max() < 0.0006
assert np.array_equal(confidence > 0, values > 0)
assert views.shape == (*values.shape, 3) and views.std() > 10
assert np.array_equal(views, read_frames("images/rectified-left/%06d.png", "bgr24"))
assert len(read_frames("slow/disparity.mkv")) == len(values)
print("all formats are equal")
"""


def programs(language):
    return [text for name, text in BLOCK.findall(PAGE.read_text()) if name == language]


class Application(ClipTest):
    def need_numpy(self):
        if run([PYTHON, "-c", "import numpy"], self.folder).status != 0:
            self.skipTest("NumPy is missing (python3-numpy)")

    def test_the_program_of_the_library_is_the_installed_example(self):
        shown = programs("cpp")
        self.assertEqual(len(shown), 1)
        built = (SOURCE / "pipelines/examples/match_pair.cpp").read_text()
        self.assertTrue(built.endswith(shown[0]), "the page shows another program")

    def build_c_program(self):
        shown = programs("c")
        self.assertEqual(len(shown), 1)
        (self.folder / "depth_at_center.c").write_text(shown[0])
        flags = subprocess.run(["pkg-config", "--cflags", "--libs", "gstreamer-app-1.0", "gstreamer-video-1.0"],
                               check=True, capture_output=True, text=True).stdout.split()
        require(run(["gcc", "-Wall", "-Wextra", "-Werror", "-o", "depth-at-center", "depth_at_center.c", *flags],
                    self.folder))
        return self.folder / "depth-at-center"

    def test_c_program_prints_depth_and_confidence(self):
        program = self.build_c_program()
        done = require(run([program, "left.mp4", "right.mp4", str(FOCAL_TIMES_BASELINE)], self.folder))
        lines = done.output.splitlines()
        self.assertEqual(len(lines), FRAMES, str(done))
        found = re.findall(r"([\d.]+) px, ([\d.]+) m, confidence (\d+)", done.output)
        self.assertEqual(len(found) + lines.count("unknown"), FRAMES, str(done))
        self.assertGreater(len(found), 0, str(done))
        for disparity, depth, confidence in found:
            self.assertAlmostEqual(float(disparity) * float(depth), FOCAL_TIMES_BASELINE, delta=0.1)
            self.assertTrue(1 <= int(confidence) <= 255, str(done))
        missing = run([program, "left.mp4", "no.mp4", "1"], self.folder, 20)
        self.assertEqual(missing.status, 1, str(missing))
        self.assertNotEqual(missing.errors, "")

    def run_python(self, text, *arguments):
        program = self.folder / "program.py"
        program.write_text(text)
        return run([PYTHON, program, *arguments], self.folder, 120)

    # Feature: results that other programs read
    def test_python_reads_the_results_of_recordings(self):
        self.need_numpy()
        if not shutil.which("ffmpeg"):
            self.skipTest("ffmpeg is not installed")
        (self.folder / "stereo.yaml").write_text(CALIBRATION)
        for out, form in (("result", "mkv"), ("images", "png"), ("floats", "pfm")):
            require(run([BUILD / "pipelines/programs/run/mtstereo-run", "left.mp4", "right.mp4", "--calibration",
                         "stereo.yaml", "--what", "disparity,depth,confidence,rectified", "--format", form, "--out",
                         out], self.folder))
        # Of rates below 5 per second that are no simple fraction, ffmpeg takes a multiple for the rate.
        require(run([BUILD / "pipelines/programs/run/mtstereo-run", "images/rectified-left", "images/rectified-right",
                     "--rate", "0.5752", "--what", "disparity", "--out", "slow"], self.folder))
        done = require(self.run_python(programs("python")[0] + CHECK_OF_RESULTS))
        self.assertRegex(done.output, r"^\d+ maps, median \d+\.\d+ px, \d+\.\d+ m\n")
        self.assertIn("all formats are equal", done.output)

    def test_no_program_is_left_out(self):
        languages = {name for name, _ in BLOCK.findall(PAGE.read_text())} - {"console", "sh"}
        self.assertEqual(languages, {"c", "cpp", "python"})
        self.assertEqual([len(programs(name)) for name in sorted(languages)], [1, 1, 1])


if __name__ == "__main__":
    unittest.main(verbosity=2)
