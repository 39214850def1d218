# SPDX-License-Identifier: LGPL-2.1-or-later
"""The maps of the module are those of the library, byte for byte."""
import itertools
import tracemalloc
import unittest

import mtstereo
import numpy as np

from support import library_maps, views


def strided(image, row_padding=0, pixel_step=1, backward=False, transposed=False):
    """The same pixels in another layout."""
    height, width = image.shape
    shape = (width, (height + row_padding) * pixel_step) if transposed else (height, (width + row_padding) * pixel_step)
    memory = np.full(shape, 77, np.uint8)
    result = memory[:, ::pixel_step]
    result = result[:, :height].T if transposed else result[:, :width]
    result = result[::-1] if backward else result
    result[:] = image
    return result


class Maps(unittest.TestCase):
    def check(self, pairs, **parameters):
        matcher = mtstereo.Matcher(**parameters)
        for pair, (disparity, confidence) in zip(pairs, library_maps(pairs, **parameters)):
            result = matcher(*pair)
            self.assertEqual(result.disparity.dtype, np.float32)
            self.assertEqual(result.disparity.tobytes(), disparity.tobytes())
            self.assertEqual(result.confidence.tobytes(), confidence.tobytes())
            self.assertEqual(result.disparity.shape, pair[0].shape)
        return result

    # Feature: disparity and confidence as arrays, byte for byte those of library and element
    def test_equal_those_of_the_library_in_every_mode_and_preset(self):
        modes, presets = (row.choices for row in (parameter("mode"), parameter("preset")))
        for mode, preset in itertools.product(modes, presets):
            with self.subTest(mode=mode, preset=preset):
                result = self.check([views(161, 75)], mode=mode, preset=preset, max_disparity=32)
                self.assertGreater(result.density, 0.01)

    # Feature: disparity and confidence as arrays, byte for byte those of library and element
    def test_equal_those_of_the_library_at_every_size(self):
        for width, height in ((1, 1), (1, 9), (9, 1), (2, 2), (33, 7), (127, 65), (640, 480)):
            with self.subTest(width=width, height=height):
                self.check([views(width, height)], max_disparity=min(width, 64))

    # Feature: disparity and confidence as arrays, byte for byte those of library and element
    def test_equal_those_of_the_library_at_4k(self):
        result = self.check([views(3840, 2160, 20)], preset="fast", mode="sparse", max_disparity=64)
        self.assertGreater(result.density, 0.01)

    def test_equal_those_of_the_library_over_a_stream(self):
        pairs = [views(200, 90, seed=seed) for seed in (1, 1, 1, 2)]
        for temporal in ("off", "hold", "filter"):
            self.check(pairs, temporal=temporal, max_disparity=32)

    def test_have_negative_disparities(self):
        left, right = views(160, 80)
        result = self.check([(right, left)], min_disparity=-16, max_disparity=16)
        self.assertLess(np.nanmedian(result.disparity), -3)

    # Feature: any strides, without a copy if the pixels of a row are contiguous
    def test_do_not_depend_on_strides(self):
        pair = views(161, 75)
        matcher = mtstereo.Matcher(max_disparity=32)
        expected = matcher(*pair)
        layouts = ({"row_padding": 1}, {"row_padding": 13}, {"pixel_step": 2}, {"pixel_step": 3, "row_padding": 5},
                   {"backward": True}, {"transposed": True}, {"backward": True, "transposed": True})
        for layout in layouts:
            with self.subTest(**layout):
                for disparity, confidence in (matcher(*(strided(view, **layout) for view in pair)),
                                              matcher(strided(pair[0], **layout), pair[1])):
                    self.assertEqual(disparity.tobytes(), expected.disparity.tobytes())
                    self.assertEqual(confidence.tobytes(), expected.confidence.tobytes())

    def test_do_not_depend_on_a_repeated_row(self):
        row = views(161, 1)
        tall = [np.broadcast_to(view, (40, 161)) for view in row]  # a distance of 0 bytes
        matcher = mtstereo.Matcher(max_disparity=32)
        self.assertEqual(matcher(*tall).disparity.tobytes(),
                         matcher(*map(np.ascontiguousarray, tall)).disparity.tobytes())

    def test_are_found_in_arrays_that_cannot_be_written(self):
        pair = views(64, 48)
        expected = mtstereo.Matcher(max_disparity=16)(*pair)
        for view in pair:
            view.flags.writeable = False
        self.assertEqual(mtstereo.Matcher(max_disparity=16)(*pair).disparity.tobytes(), expected.disparity.tobytes())

    def test_belong_to_the_caller(self):
        matcher = mtstereo.Matcher(max_disparity=32)
        result = matcher(*views(161, 75))
        kept = result.disparity.copy(), result.confidence.copy()
        matcher(*views(161, 75, seed=2))
        del matcher
        self.assertEqual(result.disparity.tobytes(), kept[0].tobytes())
        self.assertEqual(result.confidence.tobytes(), kept[1].tobytes())
        self.assertTrue(result.disparity.flags.writeable and result.disparity.flags.owndata)

    def test_have_figures(self):
        result = mtstereo.Matcher(max_disparity=32)(*views(161, 75))
        self.assertAlmostEqual(result.density, np.isfinite(result.disparity).mean())
        self.assertGreater(result.milliseconds, 0)
        self.assertFalse(result.half_resolution)
        self.assertEqual(result.fine_detail, 0)


class Views(unittest.TestCase):
    def allocated(self, *pair):
        """The memory that NumPy takes for a pair [bytes]."""
        matcher = mtstereo.Matcher(max_disparity=16)
        matcher(*pair)
        tracemalloc.start()
        matcher(*pair)
        most = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        return most

    # Feature: any strides, without a copy if the pixels of a row are contiguous
    def test_are_not_copied_if_pixels_are_contiguous_in_rows(self):
        width, height = 321, 240
        pair, results = views(width, height), 5 * width * height
        self.assertLess(self.allocated(*pair), results + 5000)
        self.assertLess(self.allocated(*(strided(view, row_padding=3) for view in pair)), results + 5000)
        copied = self.allocated(*(strided(view, pixel_step=2) for view in pair))
        self.assertGreater(copied, results + 2 * width * height)


def parameter(name):
    return next(row for row in mtstereo.parameter_table() if row.name == name)


class Parameters(unittest.TestCase):
    # Feature: every parameter as a keyword, in types and texts
    def test_are_those_of_the_table(self):
        names = [row.name for row in mtstereo.parameter_table()]
        self.assertEqual(list(mtstereo.Matcher().parameters), names)
        self.assertEqual(names[:3], ["preset", "mode", "max_disparity"])
        for row in mtstereo.parameter_table():
            self.assertIn(f"\n{row.name}: ", mtstereo.Matcher.__doc__)
            self.assertIn(row.help, mtstereo.Matcher.__doc__)
            self.assertTrue(row.default)

    def test_of_every_type_keep_their_value(self):
        values = {"mode": "dense", "max_disparity": 32, "min_disparity": -3, "noise_filter": False,
                  "max_node_width": 0.25, "node_levels": (2, 1, 0), "pixel_search_range": 20.0, "min_confidence": 0}
        self.assertLessEqual(values.items(), mtstereo.Matcher(**values).parameters.items())
        for row in mtstereo.parameter_table():  # the values in effect are accepted
            value = mtstereo.Matcher().parameters[row.name]
            self.assertEqual(mtstereo.Matcher(**{row.name: value}).parameters, mtstereo.Matcher().parameters)

    def test_of_numpy_are_accepted(self):
        matcher = mtstereo.Matcher(max_disparity=np.int64(32), noise_filter=np.bool_(False),
                                   max_node_width=np.float32(0.5), node_levels=[np.uint8(1), np.uint8(0)])
        self.assertEqual(matcher.parameters["max_disparity"], 32)
        self.assertEqual(matcher.parameters["node_levels"], (1, 0))

    def test_that_are_set_take_effect_for_the_next_pair(self):
        pair = views(161, 75)
        matcher = mtstereo.Matcher(max_disparity=32)
        matcher(*pair)
        matcher.set(mode="full", max_disparity=16)
        self.assertEqual(matcher(*pair).disparity.tobytes(),
                         mtstereo.Matcher(mode="full", max_disparity=16)(*pair).disparity.tobytes())
        matcher.set(max_disparity=None)
        self.assertEqual(matcher.parameters["max_disparity"], 64)

    def test_that_are_refused_change_nothing(self):
        matcher = mtstereo.Matcher(max_disparity=32)
        with self.assertRaises(ValueError):
            matcher.set(mode="full", max_disparity=0)
        self.assertEqual(matcher.parameters, mtstereo.Matcher(max_disparity=32).parameters)


class Stream(unittest.TestCase):
    def test_of_pairs_can_be_forgotten(self):
        pair, other = views(161, 75), views(161, 75, seed=2)
        for again in ("forget", "restart"):
            matcher = mtstereo.Matcher(temporal="filter", max_disparity=32)
            alone = matcher(*pair).disparity.tobytes()
            for _ in range(3):
                matcher(*other)
            getattr(matcher, again)()
            self.assertEqual(matcher(*pair).disparity.tobytes(), alone)


if __name__ == "__main__":
    unittest.main(verbosity=2)
