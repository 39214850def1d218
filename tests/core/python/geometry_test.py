# SPDX-License-Identifier: LGPL-2.1-or-later
"""Calibrations, rectified views, depths and points; wrong use names the argument or the file."""
import pathlib
import pickle
import tempfile
import unittest

import mtstereo
import numpy as np

from support import views

FILES = pathlib.Path(__file__).parents[2] / "geometry/files"
OPENCV = f"{FILES}/intrinsics.yml,{FILES}/extrinsics.yml"
CAMERAS = mtstereo.Rectification(focal_length=500, baseline=0.2, center_x=31.5, center_y=20, principal_offset=1.5)


def map_of_disparities():
    disparity = np.random.default_rng(1).integers(1, 90 * 256, (40, 64)).astype(np.float32) / 256
    disparity[::3, ::2] = np.nan
    return disparity


class Calibrations(unittest.TestCase):
    # Feature: calibrations, rectified views, depths and points
    def test_are_read_from_files(self):
        calibration = mtstereo.Calibration.read(OPENCV, 640, 480)
        self.assertEqual((calibration.format, calibration.left.width, calibration.right.height), ("OpenCV", 640, 480))
        self.assertAlmostEqual(calibration.left.matrix[0, 2], 342.37038)
        self.assertEqual(calibration.left.matrix[2].tolist(), [0, 0, 1])
        self.assertEqual((calibration.left.lens, len(calibration.left.coefficients)), ("plumb-bob", 5))
        self.assertAlmostEqual(calibration.translation[0], -0.12153)
        self.assertAlmostEqual(calibration.baseline, np.linalg.norm(calibration.translation))
        self.assertTrue(np.allclose(calibration.rotation @ calibration.rotation.T, np.eye(3), atol=1e-6))
        self.assertEqual(mtstereo.Calibration.read(FILES / "camchain.yaml").format, "Kalibr camchain")

    def test_are_written_scaled_and_read_again(self):
        calibration = mtstereo.Calibration.read(OPENCV, 640, 480)
        with tempfile.TemporaryDirectory(prefix="mtstereo-") as folder:
            file = pathlib.Path(folder) / "half.yml"
            calibration.scaled(320, 240).write(file)
            half = mtstereo.Calibration.read(file)
        self.assertEqual(half.left.width, 320)
        self.assertAlmostEqual(2 * half.left.matrix[0, 0], calibration.left.matrix[0, 0])
        self.assertTrue(np.allclose(half.rotation, calibration.rotation))

    def test_that_cannot_be_used_are_refused_by_name(self):
        for arguments, message in (((FILES / "none.yml",), "none.yml: cannot be read"), ((__file__,), "geometry_test.py"),
                                   ((f"{FILES}/euroc_cam0.yaml",), "euroc_cam0.yaml"), (("",), "")):
            with self.assertRaisesRegex(ValueError, message):
                mtstereo.Calibration.read(*arguments)
        for arguments in ((), (3,), (OPENCV, "640", 480)):
            with self.assertRaises(TypeError):
                mtstereo.Calibration.read(*arguments)
        calibration = mtstereo.Calibration.read(OPENCV, 640, 480)
        with self.assertRaisesRegex(ValueError, "the aspect ratios differ"):
            calibration.scaled(100, 1000)
        with self.assertRaisesRegex(OSError, "/none/out.yml"):
            calibration.write("/none/out.yml")


class Rectified(unittest.TestCase):
    def setUp(self):
        self.calibration = mtstereo.Calibration.read(OPENCV, 640, 480)
        self.rectification = mtstereo.rectify(self.calibration)

    def test_cameras_have_figures(self):
        self.assertEqual((self.rectification.width, self.rectification.height), (640, 480))
        self.assertAlmostEqual(self.rectification.baseline, self.calibration.baseline)
        self.assertIn("baseline 0.122 m", str(self.rectification))
        self.assertEqual(mtstereo.rectification_remarks(self.calibration, self.rectification), [])
        small = mtstereo.rectify(self.calibration, alpha=1, width=320, height=240, zero_disparity=False)
        self.assertEqual((small.width, small.height), (320, 240))
        self.assertLess(small.focal_length, self.rectification.focal_length)

    # Feature: calibrations, rectified views, depths and points
    def test_views_of_every_layout_are_equal(self):
        rectifier = mtstereo.Rectifier(self.calibration, self.rectification)
        left, right = views(640, 480)
        expected = rectifier(left, right)
        self.assertEqual((expected[0].shape, expected[0].dtype), ((480, 640), np.uint8))
        self.assertFalse(np.array_equal(expected[0], left))
        for channels in (3, 4):
            color = rectifier(np.dstack([left] * channels), np.dstack([right] * channels))
            for view, gray in zip(color, expected):
                self.assertEqual(view.shape, (480, 640, channels))
                self.assertTrue((view == gray[:, :, None]).all())
        for view, gray in zip(rectifier(np.asfortranarray(left), np.dstack([right] * 3)[:, ::-1, 1][:, ::-1]), expected):
            self.assertTrue(np.array_equal(view, gray))

    def test_views_have_a_border(self):
        wide = mtstereo.rectify(self.calibration, alpha=1)
        white = np.full((480, 640), 255, np.uint8)
        left, _ = mtstereo.Rectifier(self.calibration, wide)(white, white, border=9)
        self.assertEqual(left.min(), 9)

    def test_views_that_are_wrong_are_refused(self):
        rectifier = mtstereo.Rectifier(self.calibration, self.rectification)
        left, right = views(640, 480)
        for wrong, error, message in ((left[1:], ValueError, "640x479 px"), (None, TypeError, "left is None"),
                                      (left[:, :, None], ValueError, r"left .*\(480, 640, 1\): pass"),
                                      (left / 2, TypeError, "left has the dtype float64")):
            with self.assertRaisesRegex(error, message):
                rectifier(wrong, right)
        with self.assertRaises(TypeError):
            rectifier(left, right, border=256)
        with self.assertRaisesRegex(ValueError, "alpha must be 0 to 1"):
            mtstereo.rectify(self.calibration, alpha=2)
        with self.assertRaisesRegex(ValueError, "0x0 px"):
            mtstereo.rectify(mtstereo.Calibration.read(OPENCV))


class Depths(unittest.TestCase):
    # Feature: calibrations, rectified views, depths and points
    def test_are_focal_length_times_baseline_over_disparity(self):
        disparity = map_of_disparities()
        expected = (100 / (disparity.astype(np.float64) + 1.5)).astype(np.float32)
        self.assertEqual(mtstereo.depth(disparity, CAMERAS).tobytes(), expected.tobytes())
        self.assertEqual(mtstereo.depth(disparity.T.astype(np.float64), CAMERAS).tobytes(), expected.T.tobytes())

    def test_beyond_infinity_are_infinite(self):
        depths = mtstereo.depth(np.array([[-1.5, -4, np.nan, 0.5]], np.float32), CAMERAS)
        self.assertEqual(depths[0, [0, 1, 3]].tolist(), [np.inf, np.inf, 50])
        self.assertTrue(np.isnan(depths[0, 2]))

    def test_of_files_with_infinity_for_unknown_are_unknown(self):
        disparity = np.array([[np.inf, -np.inf, 0.5]], np.float32)  # as in .pfm files
        self.assertEqual(np.isnan(mtstereo.depth(disparity, CAMERAS)).tolist(), [[True, True, False]])
        self.assertEqual(len(mtstereo.cloud(disparity, CAMERAS)), 1)

    def test_of_maps_of_another_size_are_refused(self):
        rectification = mtstereo.rectify(mtstereo.Calibration.read(OPENCV, 640, 480))
        for use in (mtstereo.depth, mtstereo.cloud):
            use(np.ones((480, 640), np.float32), rectification)
            with self.assertRaisesRegex(ValueError, "disparity has 320x240 px, but the rectified views 640x480 px"):
                use(np.ones((240, 320), np.float32), rectification)

    def test_of_wrong_maps_and_cameras_are_refused(self):
        disparity = map_of_disparities()
        for wrong, error, message in ((disparity.astype(np.uint16), TypeError, "dtype uint16: pass disparities in px"),
                                      (disparity[0], ValueError, r"shape \(64,\)"), (None, TypeError, "is None"),
                                      ([[1.0]], TypeError, "numpy.asarray"),
                                      (np.ma.masked_less(disparity, 9), TypeError, r"disparity.filled\(numpy.nan\)")):
            for use in (mtstereo.depth, mtstereo.cloud):
                with self.assertRaisesRegex(error, message):
                    use(wrong, CAMERAS)
        for cameras in ({"focal_length": 0, "baseline": 1}, {"focal_length": 1, "baseline": -1},
                        {"focal_length": 1, "baseline": 1, "principal_offset": float("nan")}):
            for use in (mtstereo.depth, mtstereo.cloud):
                with self.assertRaises(ValueError):
                    use(disparity, mtstereo.Rectification(**cameras))
        with self.assertRaises(TypeError):
            mtstereo.Rectification(focal_length=1)
        with self.assertRaises(TypeError):
            mtstereo.depth(disparity, 500, 0.2)


class Clouds(unittest.TestCase):
    # Feature: calibrations, rectified views, depths and points
    def test_have_the_points_colors_and_confidence_of_the_map(self):
        disparity = map_of_disparities()
        random = np.random.default_rng(2)
        color, confidence = random.integers(0, 256, (40, 64, 3), np.uint8), random.integers(0, 256, (40, 64), np.uint8)
        cloud = mtstereo.cloud(disparity, CAMERAS, color, confidence, near=1.5, far=20, min_confidence=40, step=2)
        depth = mtstereo.depth(disparity, CAMERAS)
        used = (depth >= 1.5) & (depth <= 20) & (confidence >= 40)
        used[1::2], used[:, 1::2] = False, False
        y, x = np.nonzero(used)
        expected = np.stack([(x - 31.5) * depth[used] / 500, (y - 20) * depth[used] / 500, depth[used]], 1)
        self.assertEqual((len(cloud), cloud.points.dtype), (used.sum(), np.float32))
        self.assertTrue(np.allclose(cloud.points, expected, rtol=1e-6, atol=1e-6))
        self.assertTrue(np.array_equal(cloud.colors, color[used]))
        self.assertTrue(np.array_equal(cloud.confidence, confidence[used]))

    def test_of_any_range_have_the_depth_of_the_map(self):
        for least, most in ((-40.25, 30), (0.25, 1980), (300, 310)):
            disparity = np.linspace(least, most, 640, dtype=np.float32).reshape(10, 64)
            depth = mtstereo.depth(disparity, CAMERAS)
            known = np.isfinite(depth) & (depth < 20)
            points = mtstereo.cloud(disparity, CAMERAS, far=20).points
            self.assertTrue(np.allclose(points[:, 2], depth[known], rtol=4e-3))

    def test_without_a_center_are_refused(self):
        cameras = mtstereo.Rectification(focal_length=500, baseline=0.2)
        self.assertTrue(np.isfinite(mtstereo.depth(map_of_disparities(), cameras)).any())
        with self.assertRaisesRegex(ValueError, r"center_x and center_y .* center_x=31.5, center_y=19.5"):
            mtstereo.cloud(map_of_disparities(), cameras)

    def test_stay_while_an_array_is_used(self):
        points = mtstereo.cloud(map_of_disparities(), CAMERAS).points
        self.assertTrue(np.isfinite(points).all())
        empty = mtstereo.cloud(np.full((4, 4), np.nan, np.float32), CAMERAS)
        self.assertEqual((len(empty), empty.points.shape, empty.confidence.shape), (0, (0, 3), (0,)))

    def test_are_written_to_files(self):
        cloud = mtstereo.cloud(map_of_disparities(), CAMERAS)
        with tempfile.TemporaryDirectory(prefix="mtstereo-") as folder:
            for name in ("a.ply", "a.pcd"):
                file = pathlib.Path(folder) / name
                cloud.write(file)
                self.assertIn(str(len(cloud)).encode(), file.read_bytes()[:600])
        for path, error, message in (("a.obj", ValueError, "'.obj': the formats are .ply and .pcd"),
                                     ("/none/a.ply", OSError, "/none/a.ply")):
            with self.assertRaisesRegex(error, message):
                cloud.write(path)

    def test_of_wrong_images_and_options_are_refused(self):
        disparity, gray = map_of_disparities(), np.zeros((40, 64), np.uint8)
        for arguments, message in (({"color": gray[1:]}, "left view"), ({"confidence": gray[1:]}, "confidence map"),
                                   ({"color": np.dstack([gray] * 4)}, "4 channels"), ({"step": 0}, "step = 0"),
                                   ({"near": 3, "far": 2}, "near"), ({"min_confidence": 256}, "min_confidence = 256"),
                                   ({"confidence": np.dstack([gray] * 3)}, "confidence has the shape")):
            with self.assertRaisesRegex(ValueError, message):
                mtstereo.cloud(disparity, CAMERAS, **arguments)


class Types(unittest.TestCase):
    def test_of_unpickled_arrays_are_accepted(self):
        left, right = pickle.loads(pickle.dumps(views(64, 48)))
        disparity = pickle.loads(pickle.dumps(mtstereo.Matcher(max_disparity=32)(left, right).disparity))
        mtstereo.depth(disparity, CAMERAS)


if __name__ == "__main__":
    unittest.main(verbosity=2)
