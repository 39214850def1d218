#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Depths and clouds of image files: every pixel by the formula, and files read back.

Frames of KITTI with their calibration file if the folder of test data exists, and a rendered clip.
"""
import array
import math
import os
import pathlib
import struct
import sys
import tempfile
import unittest

from support import SOURCE, launch, make_clip, require

sys.path.insert(0, str(SOURCE / "tests/geometry"))
from cloud_reader import read_cloud  # noqa: E402

KITTI = pathlib.Path(os.environ.get("MTSTEREO_TEST_DATA", "")) / "kitti_sequence"
FRAMES = 2
FAR = 200  # of the clouds [m]


class Rig:
    """The geometry, by the formulas of the documentation."""

    def __init__(self, focal, constant, center_x, center_y):
        self.focal, self.constant = focal, constant  # constant: focal length x baseline [px m]
        self.center = (center_x, center_y)

    def depth(self, value):
        return self.constant / (value / 256)

    def point(self, x, y, value):
        z = self.depth(value)
        return ((x - self.center[0]) * z / self.focal, (y - self.center[1]) * z / self.focal, z)


def size_of(png):
    return struct.unpack(">II", png.read_bytes()[16:24])


def words16(data, width, order="little"):
    """The rows of raw 16-bit gray frames, without padding."""
    values = array.array("H")
    values.frombytes(data)
    if order != sys.byteorder:
        values.byteswap()
    stride = (2 * width + 3) // 4 * 2
    return [list(values[i:i + width]) for i in range(0, len(values), stride)]


def is_depth(actual, depth):
    """True if a value is the depth in mm; between two values the last bit may decide."""
    exact = depth * 1000
    expected = math.floor(exact + 0.5)
    if expected > 65535:
        return actual == 0
    half = abs(exact - math.floor(exact) - 0.5) < 1e-9 * exact
    return actual == expected or (half and abs(actual - expected) == 1)


class Depths(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="mtstereo-")
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def play(self, left, right, geometry, max_disparity):
        """Writes disparities and depths as raw video, depths as PNG and FFV1, and clouds."""
        read = (f"multifilesrc location={{}} start-index=0 stop-index={FRAMES - 1} "
                "caps=image/png,framerate=10/1 ! pngdec ! videoconvert ! "
                "video/x-raw,format=GRAY8 ! {}")
        require(launch(
            f"{read.format(left, 'tee name=l')} l. ! queue ! m.sink_left l. ! queue ! c.sink_left "
            f"{read.format(right, 'm.sink_right')} "
            f"mtstereo name=m max-disparity={max_disparity} ! tee name=d "
            "d. ! queue ! filesink location=disparity.raw "
            f"d. ! queue ! mtcloud name=c {geometry} far={FAR} location=%d.pcd "
            f"d. ! queue ! mtdepth {geometry} ! tee name=z "
            "z. ! queue ! filesink location=depth.raw "
            "z. ! queue ! avenc_ffv1 ! matroskamux ! filesink location=depth.mkv "
            "z. ! queue ! videoconvert ! video/x-raw,format=GRAY16_BE ! pngenc ! "
            "multifilesink location=%d.png", self.folder))

    def check(self, rig, width, height):
        disparity = words16((self.folder / "disparity.raw").read_bytes(), width)
        depth = words16((self.folder / "depth.raw").read_bytes(), width)
        self.assertEqual(len(disparity), FRAMES * height)
        self.assertEqual(len(depth), FRAMES * height)
        known = 0
        for y, (values, depths) in enumerate(zip(disparity, depth)):
            for x, (value, written) in enumerate(zip(values, depths)):
                if value == 0:
                    self.assertEqual(written, 0, f"row {y}, column {x}")
                    continue
                known += 1
                self.assertTrue(is_depth(written, rig.depth(value)),
                                f"row {y}, column {x}: {written} of the disparity {value}")
        self.assertGreater(known, FRAMES * width * height / 3)
        for frame in range(FRAMES):
            self.check_cloud(rig, disparity[frame * height:(frame + 1) * height], frame)

    def check_cloud(self, rig, disparity, frame):
        expected = [rig.point(x, y, value) for y, row in enumerate(disparity)
                    for x, value in enumerate(row) if value > 0 and rig.depth(value) <= FAR]
        points = read_cloud(self.folder / f"{frame}.pcd")
        self.assertEqual(len(points), len(expected))
        for e, a in zip(expected, points):
            self.assertLess(max(abs(e[i] - a[i]) for i in range(3)), 1e-3, f"{e} {a}")
        grays = {point[3] for point in points}
        self.assertGreater(len(grays), 20, "the colors are those of the left view")
        self.assertTrue(all(point[3] == point[4] == point[5] for point in points))
        self.assertTrue(all(1 <= point[6] <= 255 for point in points))

    def check_recordings(self, width):
        """PNG and FFV1 have lost nothing."""
        depth = words16((self.folder / "depth.raw").read_bytes(), width)
        require(launch(f"multifilesrc location=%d.png start-index=0 stop-index={FRAMES - 1} "
                       "caps=image/png,framerate=10/1 ! pngdec ! filesink location=png.raw",
                       self.folder))
        self.assertEqual(words16((self.folder / "png.raw").read_bytes(), width, "big"), depth)
        require(launch("filesrc location=depth.mkv ! matroskademux ! avdec_ffv1 ! "
                       "video/x-raw,format=GRAY16_LE ! filesink location=mkv.raw", self.folder))
        self.assertEqual(words16((self.folder / "mkv.raw").read_bytes(), width), depth)

    # Feature: depth in mm
    def test_of_kitti_equal_the_formula_and_are_read_back(self):
        if not (KITTI / "calib.txt").is_file():
            self.skipTest(f"there is no {KITTI}")
        rows = [list(map(float, line.replace("P0:", "").replace("P1:", "").split()))
                for line in (KITTI / "calib.txt").read_text().splitlines()[:2]]
        rig = Rig(rows[0][0], -rows[1][3], rows[0][2], rows[0][6])
        width, height = size_of(KITTI / "image_l/000000.png")
        self.play(KITTI / "image_l/%06d.png", KITTI / "image_r/%06d.png",
                  f"calibration={KITTI / 'calib.txt'}", 100)
        self.check(rig, width, height)

    def test_of_a_rendered_clip_equal_the_formula_and_are_read_back(self):
        make_clip(self.folder, frames=FRAMES)
        width, height = size_of(self.folder / "left/000000.png")
        self.play("left/%06d.png", "right/%06d.png", "focal-length=136 baseline=0.1", 40)
        self.check(Rig(136, 13.6, (width - 1) / 2, (height - 1) / 2), width, height)
        self.check_recordings(width)


if __name__ == "__main__":
    unittest.main(verbosity=2)
