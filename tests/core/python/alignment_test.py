# SPDX-License-Identifier: LGPL-2.1-or-later
"""Alignment finds the rows of a pair, and the matcher corrects them."""
import unittest

import mtstereo
import numpy as np

from support import views


class Alignment(unittest.TestCase):
    def setUp(self):
        self.left, right = views(320, 200)
        self.lowered = np.roll(right, 2, 0)  # the right view is 2 rows lower

    def test_finds_rows_that_are_off_and_the_matcher_corrects_them(self):
        alignment, matcher = mtstereo.Alignment(), mtstereo.Matcher(max_disparity=32)
        wrong = matcher(self.left, self.lowered).density
        alignment.watch(self.left, self.lowered)
        findings = alignment.inspect(self.left, self.lowered, max_disparity=32)
        self.assertTrue(findings.trusted, findings.status)
        self.assertAlmostEqual(findings.field.offset, 2, delta=0.2)
        self.assertGreater(findings.inliers, 50)
        matcher.correction = alignment.correction
        self.assertEqual(matcher.correction, alignment.correction)
        self.assertGreater(matcher(self.left, self.lowered).density, wrong + 0.2)
        self.assertTrue(alignment.trusted)
        self.assertEqual(alignment.views, 1)

    def test_names_what_is_wrong_with_the_streams(self):
        alignment = mtstereo.Alignment()
        self.assertEqual(alignment.problems, {})
        blank = np.full_like(self.left, 9)
        for _ in range(20):
            alignment.watch(blank, self.lowered)
        self.assertEqual(list(alignment.problems), ["left-blank"])
        alignment.reset()
        self.assertEqual(alignment.problems, {})

    def test_continues_with_the_field_of_an_earlier_run(self):
        field = mtstereo.RowField(offset=1.5, roll=-0.25)
        self.assertEqual(mtstereo.RowField.parse(str(field)), field)
        alignment = mtstereo.Alignment()
        alignment.restore(field)
        self.assertEqual(alignment.correction.rows, field)
        self.assertAlmostEqual(field.largest(640, 480), 1.75, delta=0.01)

    def test_says_why_a_pair_is_not_trusted(self):
        findings = mtstereo.Alignment().inspect(self.left[:20, :20], self.lowered[:20, :20], 16)
        self.assertFalse(findings.trusted)
        self.assertIn("too small", findings.status)


if __name__ == "__main__":
    unittest.main(verbosity=2)
