#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""mtstereo-compare: its figures on synthetic maps, its image, and invalid input."""
import pathlib
import struct
import tempfile
import unittest
import zlib

from support import COMPARE, run

WIDTH, HEIGHT = 8, 4


def write_png(file, values, depth):
    """A gray PNG image with 8 or 16 bits."""
    def chunk(name, data):
        body = name + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))
    form = ">%dH" if depth == 16 else ">%dB"
    rows = b"".join(b"\0" + struct.pack(form % len(row), *row) for row in values)
    header = struct.pack(">IIBBBBB", len(values[0]), len(values), depth, 0, 0, 0, 0)
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) +
                     chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def write_pfm(file, values):
    file.parent.mkdir(parents=True, exist_ok=True)
    rows = b"".join(struct.pack("<%df" % len(row), *row) for row in reversed(values))
    file.write_bytes(b"Pf\n%d %d\n-1.0\n" % (len(values[0]), len(values)) + rows)


def everywhere(value):
    return [[value] * WIDTH for _ in range(HEIGHT)]


class Compare(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory(prefix="mtstereo-")
        self.folder = pathlib.Path(self.temporary.name)
        self.addCleanup(self.temporary.cleanup)
        # Two frames with a true disparity of 10 px. Frame 0: 11 px everywhere. Frame 1: the upper
        # half is 14 px, the lower half unknown.
        half = HEIGHT // 2
        write_png(self.folder / "d/000000.png", everywhere(11 * 256), 16)
        write_png(self.folder / "d/000001.png",
                  [[14 * 256] * WIDTH] * half + [[0] * WIDTH] * half, 16)
        for name in ("000000", "000001"):
            write_pfm(self.folder / f"t/{name}.pfm", everywhere(10.0))
            # The left part of the upper half is visible in both views.
            seen = [[255] * 4 + [128] * 4] * half + [[255] * WIDTH] * half
            write_png(self.folder / f"m/{name}.png", seen, 8)

    def compare(self, *words):
        return run([COMPARE, *words], self.folder)

    def test_the_option_that_was_meant_is_named(self):
        done = self.compare("--dispartiy", "d", "--truth", "t")
        self.assertEqual(done.status, 2, str(done))
        self.assertIn("--disparity", str(done))

    def figures(self, *words):
        done = self.compare("--disparity", "d", "--truth", "t", *words)
        self.assertEqual(done.status, 0, str(done))
        return done.output.split()

    def assert_rejects(self, done, says, status=1):
        self.assertEqual(done.status, status, str(done))
        self.assertIn(says, done.errors, str(done))

    def test_computes_means_over_frames(self):
        # avgerr (1 + 4) / 2, D-all (0 + 100) / 2, density (100 + 50) / 2
        self.assertEqual(self.figures("--label", "two"), ["two", "2", "2.500", "50.00", "75.00"])

    def test_mask_adds_pixels_visible_in_both_views(self):
        write_png(self.folder / "d/000001.png",
                  [[10 * 256] * 4 + [14 * 256] * 4] * 2 + [[0] * WIDTH] * 2, 16)
        self.assertEqual(self.figures("--mask", "m"),
                         ["clip", "2", "1.500", "25.00", "75.00", "0.500", "0.00"])

    def test_infinite_truth_is_ignored(self):
        infinite = float("inf")
        for name in ("000000", "000001"):
            write_pfm(self.folder / f"t/{name}.pfm", [[10.0] * 7 + [infinite]] * HEIGHT)
        self.assertEqual(self.figures()[2:4], ["2.500", "50.00"])

    def test_image_shows_left_disparity_and_truth(self):
        write_png(self.folder / "l/000000.png", everywhere(100), 8)
        write_png(self.folder / "l/000001.png", everywhere(100), 8)
        self.figures("--left", "l", "--picture", "new/p.png", "--frame", "1")
        data = (self.folder / "new/p.png").read_bytes()
        self.assertEqual(struct.unpack(">II", data[16:24]), (3 * WIDTH, HEIGHT))

    def test_image_can_be_scaled_down(self):
        done = self.compare("--disparity", "d", "--picture", "p.png", "--width", "4")
        self.assertEqual(done.status, 0, str(done))
        data = (self.folder / "p.png").read_bytes()
        self.assertEqual(struct.unpack(">II", data[16:24]), (4, 2))

    def test_lost_frame_is_an_error(self):
        (self.folder / "d/000001.png").unlink()
        self.assert_rejects(self.compare("--disparity", "d", "--truth", "t"), "000001")

    def test_frame_without_truth_is_an_error(self):
        (self.folder / "t/000000.pfm").unlink()
        self.assert_rejects(self.compare("--disparity", "d", "--truth", "t"), "000000")

    def test_frame_without_mask_is_an_error(self):
        (self.folder / "m/000000.png").unlink()
        done = self.compare("--disparity", "d", "--truth", "t", "--mask", "m")
        self.assert_rejects(done, "000000")

    def test_different_sizes_are_an_error(self):
        write_pfm(self.folder / "t/000001.pfm", [[10.0] * 3] * 3)
        self.assert_rejects(self.compare("--disparity", "d", "--truth", "t"), "000001.pfm")

    def test_corrupt_image_is_named(self):
        (self.folder / "d/000001.png").write_bytes(b"no image")
        self.assert_rejects(self.compare("--disparity", "d", "--truth", "t"), "000001.png")

    def test_corrupt_truth_is_named(self):
        truth = self.folder / "t/000001.pfm"
        truth.write_bytes(truth.read_bytes()[:-5])
        self.assert_rejects(self.compare("--disparity", "d", "--truth", "t"), "000001.pfm")

    def test_missing_folder_is_named(self):
        self.assert_rejects(self.compare("--disparity", "none", "--truth", "t"), "none")

    def test_empty_folder_is_named(self):
        (self.folder / "empty").mkdir()
        self.assert_rejects(self.compare("--disparity", "empty", "--truth", "t"), "empty")

    def test_missing_frame_is_an_error(self):
        done = self.compare("--disparity", "d", "--picture", "p.png", "--frame", "2")
        self.assert_rejects(done, "frame 2")

    def test_unwritable_image_is_named(self):
        done = self.compare("--disparity", "d", "--picture", "/dev/null/p.png")
        self.assert_rejects(done, "/dev/null")

    def write_depths(self):
        # True depths of 4 m and 8 m; the near half is 1 % too far, an eighth of the rest is unknown.
        write_pfm(self.folder / "z/000000.pfm", [[4.0] * WIDTH] * 2 + [[8.0] * WIDTH] * 2)
        write_png(self.folder / "e/000000.png",
                  [[4040] * WIDTH] * 2 + [[8000] * WIDTH, [8160] * 6 + [0] * 2], 16)

    def test_depth_errors_are_shares_of_the_true_depth(self):
        self.write_depths()
        done = self.compare("--depth", "e", "--true-depth", "z")
        self.assertEqual(done.status, 0, str(done))
        rows = [line.split() for line in done.output.splitlines()]
        self.assertEqual(rows[1:], [["0", "..", "5", "100.0", "1.00", "1.00"],
                                    ["5", "..", "10", "87.5", "0.00", "2.00"]])

    def test_depths_of_another_size_are_an_error(self):
        self.write_depths()
        write_pfm(self.folder / "z/000000.pfm", [[4.0] * 3] * 3)
        self.assert_rejects(self.compare("--depth", "e", "--true-depth", "z"), "another size")

    def test_depths_need_images_of_16_bits_and_their_truth(self):
        self.write_depths()
        write_png(self.folder / "e/000000.png", everywhere(40), 8)
        self.assert_rejects(self.compare("--depth", "e", "--true-depth", "z"), "16 bits")
        self.assert_rejects(self.compare("--depth", "e"), "--true-depth", 2)

    def test_invalid_options_are_rejected(self):
        self.assert_rejects(self.compare("--truth", "t"), "--disparity", 2)
        self.assert_rejects(self.compare("--disparity", "d"), "nothing to do", 2)
        self.assert_rejects(self.compare("--disparity", "d", "--max-disparity", "0"),
                            "--max-disparity", 2)


if __name__ == "__main__":
    unittest.main(verbosity=2)
