# SPDX-License-Identifier: LGPL-2.1-or-later
"""Wrong use is an exception that names the argument and the remedy, and the matcher can be used afterwards."""
import copy
import os
import pickle
import subprocess
import sys
import textwrap
import unittest

import mtstereo
import numpy as np

from support import views

LEFT, RIGHT = views(64, 48)

ARRAYS = [
    ("a missing file", lambda: None, TypeError, "left is None: cv2.imread"),
    ("a list", lambda: LEFT.tolist(), TypeError, r"left is of type list: .* numpy.asarray\(left\)"),
    ("bytes", lambda: LEFT.tobytes(), TypeError, "left is of type bytes: pass a NumPy array"),
    ("a file name", lambda: "left.png", TypeError, "left is of type str"),
    ("floats", lambda: LEFT / 255, TypeError, r"left has the dtype float64, .* left.astype\(numpy.uint8\)"),
    ("signed bytes", lambda: LEFT.astype(np.int8), TypeError, "left has the dtype int8"),
    ("truths", lambda: LEFT > 9, TypeError, "left has the dtype bool"),
    ("objects", lambda: LEFT.astype(object), TypeError, "left has the dtype object"),
    ("16 bits", lambda: LEFT.astype(np.uint16), TypeError, r"left has the dtype uint16, .*\(left >> 8\)"),
    ("swapped 16 bits", lambda: LEFT.astype(">u2"), TypeError, "left has the dtype >u2"),
    ("records", lambda: np.zeros((48, 64), [("r", "u1")]), TypeError, "left has the dtype"),
    ("a mask", lambda: np.ma.masked_less(LEFT, 9), TypeError, r"left is a masked array.* left.filled\(0\)"),
    ("BGR", lambda: np.dstack([LEFT] * 3), ValueError, r"a color image: .* cv2.cvtColor\(left, cv2.COLOR_BGR2GRAY\)"),
    ("BGRA", lambda: np.dstack([LEFT] * 4), ValueError, r"cv2.cvtColor\(left, cv2.COLOR_BGRA2GRAY\)"),
    ("one channel", lambda: LEFT[:, :, None], ValueError, r"shape \(48, 64, 1\): pass one image"),
    ("a row", lambda: LEFT[0], ValueError, r"shape \(64,\): pass one image, of the shape \(height, width\)"),
    ("a number", lambda: np.array(3, np.uint8), ValueError, r"shape \(\): pass one image"),
    ("several images", lambda: np.stack([LEFT] * 7), ValueError, r"shape \(7, 48, 64\)"),
    ("no rows", lambda: LEFT[:0], ValueError, r"shape \(0, 64\): each side must be 1 to 16384 px"),
    ("no columns", lambda: LEFT[:, :0], ValueError, r"shape \(48, 0\): each side must be 1 to 16384 px"),
    ("a huge image", lambda: np.broadcast_to(LEFT[0, 0], (2, 16385)), ValueError, "each side must be 1 to 16384 px"),
    ("another size", lambda: LEFT[:-1], ValueError, "the left image is 64x47 px, the right image 64x48 px"),
    ("a small image", lambda: LEFT[:, :40], ValueError, "the left image is 40x48 px"),
]

KEYWORDS = [
    ({"max_disp": 64}, TypeError, "there is no parameter 'max_disp': the parameters are preset, mode, max_disparity"),
    ({"max-disparity": 64}, TypeError, "there is no parameter 'max-disparity'"),
    ({"maxDisparity": 64}, TypeError, "there is no parameter 'maxDisparity'"),
    ({"max_disparity": 0}, ValueError, "max_disparity = 0 is invalid: allowed are 1 to 1984 px"),
    ({"max_disparity": 64.0}, TypeError, "max_disparity = 64.0 has the type float: pass int, 1 to 1984 px"),
    ({"max_disparity": "64"}, TypeError, "max_disparity = '64' has the type str"),
    ({"max_disparity": True}, TypeError, "max_disparity = True has the type bool"),
    ({"max_disparity": [64]}, TypeError, "max_disparity = .64. has the type list"),
    ({"max_disparity": 10 ** 400}, ValueError, "max_disparity = inf is invalid"),
    ({"min_disparity": -2000}, ValueError, "min_disparity = -2000 is invalid: allowed are -1024 to 1024 px"),
    ({"mode": "densest"}, ValueError, 'mode = "densest" is invalid: allowed are sparse or semi-dense'),
    ({"mode": "semi_dense"}, ValueError, 'mode = "semi_dense" is invalid'),
    ({"mode": 2}, TypeError, "mode = 2 has the type int: pass 'sparse', 'semi-dense', 'dense', 'full'"),
    ({"mode": b"dense"}, TypeError, "has the type bytes"),
    ({"noise_filter": 1}, TypeError, "noise_filter = 1 has the type int: pass bool"),
    ({"noise_filter": "false"}, TypeError, "noise_filter = 'false' has the type str: pass bool"),
    ({"max_node_width": "wide"}, TypeError, "max_node_width = 'wide' has the type str: pass float, 0.001 to 1"),
    ({"max_node_width": float("nan")}, ValueError, "max_node_width = nan is invalid"),
    ({"max_node_width": 1j}, TypeError, "complex"),
    ({"census_kernel_size": 4}, ValueError, "census_kernel_size = 4 is invalid: .* odd"),
    ({"node_levels": (1,)}, ValueError, 'node_levels = "1" is invalid'),
    ({"node_levels": (1.0, 0)}, TypeError, "node_levels = .* pass str or sequence of int"),
    ({"node_levels": 0}, TypeError, "node_levels = 0 has the type int"),
]

FRAMES = [
    ({"max_disparity": 65}, "max_disparity = 65 px exceeds the width of images of 64x48 px: set it to 1 to 64 px"),
    ({"min_disparity": 70}, "min_disparity = 70 px and max_disparity = 64 px leave no disparity to search: set"),
    ({"min_node_width": 64}, "min_node_width = 64 px excludes every node .*: lower min_node_width or raise"),
]


class Misuse(unittest.TestCase):
    # Feature: wrong use is an exception with a remedy
    def test_of_an_array_names_the_argument_and_the_remedy(self):
        matcher, alignment = mtstereo.Matcher(max_disparity=32), mtstereo.Alignment()
        expected = matcher(LEFT, RIGHT).disparity.tobytes()
        for name, make, error, message in ARRAYS:
            with self.subTest(name):
                with self.assertRaisesRegex(error, message):
                    matcher(make(), RIGHT)
                with self.assertRaises(error) as raised:
                    matcher(LEFT, make())
                self.assertIn("right", str(raised.exception))
                with self.assertRaises(error):
                    alignment.watch(make(), RIGHT)
                with self.assertRaises(error):
                    alignment.inspect(LEFT, make(), 32)
                self.assertEqual(matcher(LEFT, RIGHT).disparity.tobytes(), expected)

    # Feature: wrong use is an exception with a remedy
    def test_of_a_keyword_names_it_and_what_is_allowed(self):
        matcher = mtstereo.Matcher()
        before = matcher.parameters
        for keywords, error, message in KEYWORDS:
            with self.subTest(**keywords):
                for use in (mtstereo.Matcher, matcher.set):
                    with self.assertRaisesRegex(error, message):
                        use(**keywords)
                self.assertEqual(matcher.parameters, before)

    # Feature: wrong use is an exception with a remedy
    def test_of_parameters_that_do_not_fit_says_what_fits(self):
        for keywords, message in FRAMES:
            with self.subTest(**keywords):
                matcher = mtstereo.Matcher(**keywords)
                with self.assertRaisesRegex(ValueError, message):
                    matcher(LEFT, RIGHT)
                matcher.set(**dict.fromkeys(keywords))
                matcher(LEFT, RIGHT)

    def test_of_the_call_is_a_type_error(self):
        matcher = mtstereo.Matcher()
        for arguments in ((), (LEFT,), (LEFT, RIGHT, LEFT)):
            with self.assertRaises(TypeError):
                matcher(*arguments)
        with self.assertRaises(TypeError):
            mtstereo.Matcher("dense")
        with self.assertRaises(TypeError):
            matcher(LEFT, RIGHT, mode="dense")

    def test_of_corrections_is_refused(self):
        matcher, alignment = mtstereo.Matcher(), mtstereo.Alignment()
        for correction in (mtstereo.ViewCorrection(left_blur=4), mtstereo.ViewCorrection(right_blur=float("nan")),
                           mtstereo.ViewCorrection(mtstereo.RowField(offset=101))):
            with self.assertRaises(ValueError):
                matcher.correction = correction
        self.assertEqual(matcher.correction, mtstereo.ViewCorrection())
        with self.assertRaises(TypeError):
            matcher.correction = None
        with self.assertRaises(ValueError):
            alignment.restore(mtstereo.RowField(roll=1e9))
        for text in ("", "1,2", "1,2,3,4,x", "1,2,3,4,500"):
            with self.assertRaises(ValueError):
                mtstereo.RowField.parse(text)

    def test_of_copies_is_refused(self):
        for copied in (copy.copy, copy.deepcopy, pickle.dumps):
            with self.assertRaises(TypeError):
                copied(mtstereo.Matcher())

    # Feature: threads, processes and sub-interpreters
    def test_after_a_fork_is_an_error_and_no_hang(self):
        done = subprocess.run([sys.executable, "-c", textwrap.dedent("""
            import os, sys, mtstereo, numpy
            view = numpy.zeros((48, 64), numpy.uint8)
            matcher = mtstereo.Matcher(max_disparity=32, threads=2)
            matcher(view, view)
            if os.fork() == 0:
                try:
                    matcher(view, view)
                except RuntimeError as error:
                    print(error)
                mtstereo.Matcher(max_disparity=32, threads=2)(view, view)
                sys.exit(0)
            print(os.wait()[1])""")], capture_output=True, text=True, timeout=60, env=os.environ)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("make a Matcher in each process", done.stdout)
        self.assertEqual(done.stdout.splitlines()[-1], "0")

    # Feature: threads, processes and sub-interpreters
    def test_in_a_sub_interpreter_is_refused(self):
        try:
            import _xxsubinterpreters as interpreters
        except ImportError:
            self.skipTest("this Python has no module for sub-interpreters")
        other = interpreters.create()
        try:
            with self.assertRaisesRegex(interpreters.RunFailedError, "ImportError.*main interpreter only"):
                interpreters.run_string(other, "import mtstereo")
        finally:
            interpreters.destroy(other)


if __name__ == "__main__":
    unittest.main(verbosity=2)
