# SPDX-License-Identifier: LGPL-2.1-or-later
"""The maps of a sample of the element are those of a Matcher, byte for byte."""
import unittest

import mtstereo
import numpy as np

from support import views

try:
    from mtstereo.gst import Gst, image, maps
    Gst.init(None)
    gi_error = None
except (ImportError, ValueError) as error:  # no package gi, or no typelib of GStreamer
    gi_error = error


def caps_of(view, gray="GRAY8"):
    return Gst.Caps.from_string(f"video/x-raw,format={gray},width={view.shape[1]},height={view.shape[0]},framerate=10/1")


def padded(view):
    """The bytes of a frame, with rows of a multiple of 4 bytes."""
    rows = view.view(np.uint8).reshape(view.shape[0], -1)
    return np.pad(rows, ((0, 0), (0, -rows.shape[1] % 4)), constant_values=77).tobytes()


@unittest.skipIf(gi_error, f"GStreamer's Python bindings are missing: {gi_error}")
class Samples(unittest.TestCase):
    def samples(self, pairs, settings, downstream=""):
        """The samples of an appsink for pairs of views."""
        if not Gst.ElementFactory.find("mtstereo"):
            self.skipTest("the plugin is not built (option gst)")
        pipeline = Gst.parse_launch(
            f"mtstereo name=m alignment=off {settings} {downstream} ! appsink name=maps sync=false "
            "appsrc name=left format=time ! m.sink_left appsrc name=right format=time ! m.sink_right")
        self.addCleanup(pipeline.set_state, Gst.State.NULL)
        for side, name in enumerate(("left", "right")):
            source = pipeline.get_by_name(name)
            source.set_property("caps", caps_of(pairs[0][0]))
            for number, pair in enumerate(pairs):
                buffer = Gst.Buffer.new_wrapped(padded(pair[side]))
                buffer.pts, buffer.duration = number * Gst.SECOND // 10, Gst.SECOND // 10
                source.emit("push-buffer", buffer)
            source.emit("end-of-stream")
        sink = pipeline.get_by_name("maps")
        pipeline.set_state(Gst.State.PLAYING)
        for _ in pairs:
            sample = sink.emit("try-pull-sample", 30 * Gst.SECOND)
            self.assertTrue(sample, "no sample came")
            yield sample

    # Feature: disparity and confidence as arrays, byte for byte those of library and element
    def test_have_the_maps_of_a_matcher(self):
        for width, height, keywords in ((161, 75, {"max_disparity": 32}), (64, 48, {"mode": "dense"}),
                                        (130, 60, {"min_disparity": -8, "mode": "full"}),
                                        (161, 75, {"preset": "fast", "temporal": "filter"})):
            with self.subTest(width=width, **keywords):
                pairs = [views(width, height, seed=seed) for seed in (1, 1, 2)]
                matcher = mtstereo.Matcher(**keywords)
                settings = " ".join(f"{name.replace('_', '-')}={value}" for name, value in keywords.items())
                for sample, pair in zip(self.samples(pairs, settings), pairs):
                    expected, found = matcher(*pair), maps(sample)
                    self.assertEqual(found.disparity.tobytes(), expected.disparity.tobytes())
                    self.assertEqual(found.confidence.tobytes(), expected.confidence.tobytes())
                    self.assertEqual(found.disparity.dtype, np.float32)

    def test_use_the_scale_of_the_map(self):
        pair = views(161, 75)
        expected = mtstereo.Matcher()(*pair).disparity
        found = next(self.samples([pair], "disparity-scale=16")).get_caps().get_structure(0)
        self.assertEqual(found.get_value("disparity-scale"), 16)
        disparity = maps(next(self.samples([pair], "disparity-scale=16"))).disparity
        self.assertTrue(np.array_equal(np.isnan(disparity), np.isnan(expected)))
        self.assertLessEqual(np.nanmax(np.abs(disparity - expected)), 1 / 32)

    def test_of_gray_images_are_read_with_padded_rows(self):
        for format, dtype in (("GRAY8", np.uint8), ("GRAY16_LE", "<u2"), ("GRAY16_BE", ">u2")):
            view = np.arange(35).reshape(5, 7).astype(dtype)
            sample = Gst.Sample.new(Gst.Buffer.new_wrapped(padded(view)), caps_of(view, format))
            self.assertTrue(np.array_equal(image(sample), view), format)
            self.assertTrue(image(sample).dtype.isnative)

    def test_of_other_kinds_are_refused_with_a_remedy(self):
        view = views(64, 48)[0]
        gray = Gst.Sample.new(Gst.Buffer.new_wrapped(padded(view)), caps_of(view))
        color = Gst.Sample.new(Gst.Buffer.new_wrapped(bytes(64 * 48 * 4)), caps_of(view, "BGRx"))
        audio = Gst.Sample.new(Gst.Buffer(), Gst.Caps.from_string("audio/x-raw"))
        for sample, message in ((None, "no caps"), (color, "BGRx.*format=GRAY8 upstream"), (audio, "audio/x-raw"),
                                (Gst.Sample.new(Gst.Buffer(), None), "no caps")):
            with self.assertRaisesRegex(ValueError, message):
                maps(sample)
        with self.assertRaisesRegex(ValueError, "this is no disparity map.*link the appsink with mtstereo itself"):
            maps(gray)

    def test_without_confidence_have_none(self):
        sample = next(self.samples([views(64, 48)], ""))
        stripped = Gst.Sample.new(Gst.Buffer.new_wrapped(sample.get_buffer().extract_dup(0, sample.get_buffer().get_size())),
                                  sample.get_caps())
        self.assertIsNone(maps(stripped).confidence)
        self.assertTrue(np.array_equal(maps(stripped).disparity, maps(sample).disparity, equal_nan=True))


if __name__ == "__main__":
    unittest.main(verbosity=2)
