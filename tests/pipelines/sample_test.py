#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""depth-of-center: the sample application that reads disparity from an appsink."""
import re
import unittest

from support import CENTER, ClipTest, make_clip, make_videos, run


class DepthOfCenter(ClipTest):
    def center(self, *words):
        return run([CENTER, *words], self.folder)

    def test_prints_the_distance_of_every_frame(self):
        # The room at 160 px: f = 136 px, B = 0.1 m; the distance at the center is 1 to 5 m.
        done = self.center("left.mp4", "right.mp4", "136", "0.1")
        self.assert_succeeds(done)
        lines = done.output.splitlines()
        self.assertEqual(len(lines), 8, str(done))
        measured = [tuple(map(float, found)) for found in
                    re.findall(r"disparity +([\d.]+) px  distance +([\d.]+) m", done.output)]
        self.assertEqual(len(measured) + done.output.count("no disparity at the center"), 8, str(done))
        self.assertGreater(len(measured), 4, str(done))
        for disparity, distance in measured:
            self.assertTrue(1 < distance < 5, str(done))
            self.assertAlmostEqual(disparity * distance, 13.6, delta=0.1)

    def test_missing_file_is_named(self):
        self.assert_rejects(self.center("left.mp4", "no.mp4", "136", "0.1"), "no.mp4", 1)

    def test_different_sizes_are_reported(self):
        other = self.folder / "other"
        other.mkdir()
        make_clip(other, frames=2, size="128x96")
        make_videos(other)
        self.assert_rejects(self.center("left.mp4", "other/right.mp4", "136", "0.1"), "128x96", 1)

    def test_invalid_arguments_print_the_usage(self):
        for words in (["left.mp4"], ["left.mp4", "right.mp4"], ["left.mp4", "right.mp4", "-1", "0.1"],
                      ["left.mp4", "right.mp4", "136", "x"]):
            self.assert_rejects(self.center(*words), "usage: depth-of-center", 2)


if __name__ == "__main__":
    unittest.main(verbosity=2)
