# SPDX-License-Identifier: LGPL-2.1-or-later
"""A wall at a known distance in front of cameras with wide lenses: mtrectify, mtstereo and mtdepth
must give its distance. The lens models here are written down again, from OpenCV's documentation."""

import bisect
import math
import pathlib
import random
import statistics
import tempfile
import unittest

from support import launch, require

BASELINE = 0.1  # [m]
CELLS = 256  # of the texture, per side


def rational(k):
    """The distorted radius for the tangent of the angle to the axis."""
    def distorted(r):
        r2 = r * r
        return r * ((1 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]))) /
                    (1 + r2 * (k[5] + r2 * (k[6] + r2 * k[7]))))
    return distorted


def fisheye(k):
    """The distorted radius for the angle to the axis."""
    def distorted(angle):
        t2 = angle * angle
        return angle * (1 + t2 * (k[0] + t2 * (k[1] + t2 * (k[2] + t2 * k[3]))))
    return distorted


class Lens:
    """Directions of positions, from a table of the radii up to where the model turns back."""

    def __init__(self, model, coefficients, distorted, step):
        self.model, self.coefficients, self.step = model, coefficients, step
        self.table = [0.0]
        while len(self.table) < 20000:
            value = distorted(len(self.table) * step)
            if value <= self.table[-1]:
                break
            self.table.append(value)

    def direction(self, x, y):
        """None beyond the model."""
        radius = math.hypot(x, y)
        i = bisect.bisect_right(self.table, radius)
        if i >= len(self.table):
            return None
        below = self.table[i - 1]
        inner = (i - 1 + (radius - below) / (self.table[i] - below)) * self.step
        if self.model == "fisheye":
            scale = math.sin(inner) / radius if radius > 0 else 1
            return (x * scale, y * scale, math.cos(inner))
        scale = inner / radius if radius > 0 else 1
        return (x * scale, y * scale, 1.0)


def turn(x, y, z):
    """A rotation about z, y and x [rad], as three rows."""
    cx, sx, cy, sy, cz, sz = (f(a) for a in (x, y, z) for f in (math.cos, math.sin))
    return [[cy * cz, sx * sy * cz - cx * sz, cx * sy * cz + sx * sz],
            [cy * sz, sx * sy * sz + cx * cz, cx * sy * sz - sx * cz],
            [-sy, sx * cy, cx * cy]]


def transposed(m):
    return [list(row) for row in zip(*m)]


def product(m, v):
    return [sum(a * b for a, b in zip(row, v)) for row in m]


class Rig:
    """Two equal cameras on the x axis, turned by half of their rotation to the one and the other
    side: the rectified axes are those of the rig."""

    def __init__(self, lens, width, height, focal):
        self.lens, self.width, self.height, self.focal = lens, width, height, focal
        self.center = (width / 2 + 1.3, height / 2 - 2.1)
        self.left = turn(0.008, -0.012, 0.006)  # from the rig's axes to those of the camera
        self.right = transposed(self.left)

    def image(self, left, distance, cell, texture):
        camera, start = (self.left, 0.0) if left else (self.right, BASELINE)
        back = transposed(camera)
        pixels = bytearray()
        for v in range(self.height):
            for u in range(self.width):
                ray = self.lens.direction((u - self.center[0]) / self.focal,
                                          (v - self.center[1]) / self.focal)
                world = product(back, ray) if ray else [0, 0, 0]
                if world[2] <= 0.05:
                    pixels.append(0)
                    continue
                scale = distance / world[2]
                pixels.append(texture((start + world[0] * scale) / cell, world[1] * scale / cell))
        return bytes(pixels)

    def calibration(self):
        def matrix(name, rows, values):
            return (f"{name}: !!opencv-matrix\n   rows: {rows}\n   cols: {len(values) // rows}\n"
                    f"   dt: d\n   data: {values}\n")
        k = [self.focal, 0.0, self.center[0], 0.0, self.focal, self.center[1], 0.0, 0.0, 1.0]
        rotation = [sum(self.right[i][j] * self.right[j][n] for j in range(3))
                    for i in range(3) for n in range(3)]
        position = product(self.right, [-BASELINE, 0, 0])
        text = f"%YAML:1.0\n---\nimage_size: [ {self.width}, {self.height} ]\nlength_unit: m\n"
        text += f"distortion_model: {self.lens.model}\n"
        for number in "12":
            text += matrix("M" + number, 3, k) + matrix("D" + number, 1, self.lens.coefficients)
        return text + matrix("R", 3, rotation) + matrix("T", 3, position)


def noise():
    """Gray values that change smoothly between the nodes of a lattice."""
    values = random.Random(3)
    lattice = [[values.uniform(0, 255) for _ in range(CELLS)] for _ in range(CELLS)]

    def texture(x, y):
        column, row = math.floor(x), math.floor(y)
        fx, fy = x - column, y - row
        upper, lower = lattice[row % CELLS], lattice[(row + 1) % CELLS]
        left, right = column % CELLS, (column + 1) % CELLS
        top = upper[left] * (1 - fx) + upper[right] * fx
        return int(top * (1 - fy) + (lower[left] * (1 - fx) + lower[right] * fx) * fy)
    return texture


class Lenses(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="mtstereo-")
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def depths(self, rig, distance, cell):
        """What the elements make of a wall, in meters, without pixels that have no depth."""
        texture = noise()
        for side in ("left", "right"):
            (self.folder / side).write_bytes(rig.image(side == "left", distance, cell, texture))
        (self.folder / "rig.yml").write_text(rig.calibration())
        read = f"rawvideoparse format=gray8 width={rig.width} height={rig.height}"
        require(launch(
            " ".join(f"filesrc location={side} blocksize={rig.width * rig.height} ! {read} ! "
                     f"mtrectify camera={side} calibration=rig.yml ! queue ! m.sink_{side}"
                     for side in ("left", "right")) +
            " mtstereo name=m max-disparity=64 ! mtdepth unit=0.1 ! filesink location=depth",
            self.folder))
        data = memoryview((self.folder / "depth").read_bytes()).cast("H")
        self.assertEqual(len(data), rig.width * rig.height)
        return [1e-4 * value for value in data if value > 0]

    def check(self, rig, distance, cell):
        depths = self.depths(rig, distance, cell)
        self.assertGreater(len(depths), 0.7 * rig.width * rig.height)
        self.assertLess(abs(statistics.median(depths) / distance - 1), 0.01)
        wrong = sum(abs(depth / distance - 1) > 0.05 for depth in depths)
        self.assertLess(wrong, 0.02 * len(depths))

    def test_a_lens_with_a_pole_in_the_image(self):
        k = [-7.98, 55.4, 0.0, 0.0, -67.9, -8.06, 55.6, -68.0] + [0.0] * 6
        lens = Lens("plumb_bob", k, rational(k), 1e-4)
        self.check(Rig(lens, 320, 200, 201.0), 0.8, 0.015)

    def test_fisheye_lenses(self):
        k = [0.004, 0.003, -0.004, 0.0006]
        lens = Lens("fisheye", k, fisheye(k), 2e-4)
        for field in (160, 190):
            with self.subTest(field=field):
                focal = 320 / math.radians(field)
                self.check(Rig(lens, 320, 240, focal), 0.17, 0.012)


if __name__ == "__main__":
    unittest.main()
