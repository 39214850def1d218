#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Feature: point cloud
"""Reads the files of write_cloud() by readers that share no code with it.

cloud_reader.py, a strict reader of PLY and PCD by their specifications, always runs. Open3D (the
package python3-open3d, 155 MB) reads the same files if it is installed.

usage: read_clouds_test.py WRITE_CLOUDS
"""
import pathlib
import subprocess
import sys
import tempfile
import unittest

from cloud_reader import CloudError, read_cloud

PROGRAM = sys.argv.pop()
SYSTEM_PYTHON = "/usr/bin/python3"
TOLERANCE = 1e-3  # [m]

# Prints the number of points, and for each one its position and its color.
OPEN3D = """
import sys
import open3d
cloud = open3d.io.read_point_cloud(sys.argv[1])
print(len(cloud.points))
for p, c in zip(cloud.points, cloud.colors):
    print(*p, *(round(255 * part) for part in c))
"""


class Clouds(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="mtstereo-")
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def written(self, count):
        subprocess.run([PROGRAM, self.folder, str(count)], check=True)
        lines = (self.folder / "points.txt").read_text().splitlines()
        points = [tuple(map(float, line.split())) for line in lines]
        self.assertEqual(len(points), count)
        return points

    def assert_equal(self, expected, actual, components):
        self.assertEqual(len(expected), len(actual))
        for number, (e, a) in enumerate(zip(expected, actual)):
            self.assertEqual(len(a), components)
            for i in range(components):
                self.assertAlmostEqual(e[i], a[i], delta=TOLERANCE if i < 3 else 0,
                                       msg=f"point {number}")

    def test_points_equal_those_of_a_strict_reader(self):
        for count in (0, 1, 4096, 10001):
            points = self.written(count)
            for name in ("cloud.ply", "cloud.pcd"):
                with self.subTest(f"{count} points, {name}"):
                    self.assert_equal(points, read_cloud(self.folder / name), 7)

    def test_points_equal_those_of_open3d(self):
        if subprocess.run([SYSTEM_PYTHON, "-c", "import open3d"], capture_output=True,
                          check=False).returncode != 0:
            self.skipTest("Open3D (python3-open3d) is not installed")
        points = self.written(10001)
        for name in ("cloud.ply", "cloud.pcd"):
            with self.subTest(name):
                done = subprocess.run([SYSTEM_PYTHON, "-c", OPEN3D, self.folder / name],
                                      capture_output=True, text=True, check=True)
                lines = done.stdout.splitlines()
                self.assertEqual(int(lines[0]), len(points))
                self.assert_equal(points, [tuple(map(float, line.split())) for line in lines[1:]],
                                  6)

    def test_the_strict_reader_refuses_damaged_files(self):
        self.written(10)
        for name in ("cloud.ply", "cloud.pcd"):
            whole = (self.folder / name).read_bytes()
            damaged = self.folder / ("damaged-" + name)
            for data in (whole[:-1], whole + b"\0", whole.replace(b"10\n", b"11\n"), b"",
                         whole.replace(b"float z", b"double z").replace(b"SIZE 4", b"SIZE 8")):
                damaged.write_bytes(data)
                with self.assertRaises(CloudError, msg=name):
                    read_cloud(damaged)


if __name__ == "__main__":
    unittest.main(verbosity=2)
