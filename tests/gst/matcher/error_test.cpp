// SPDX-License-Identifier: LGPL-2.1-or-later
// Invalid input: exactly one error, with the cause, the pad and how to correct it.
#include <gtest/gtest.h>

#include "support/stereo_harness.hpp"

namespace mtstereo::test::error_test {
namespace {

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

class Refusal : public testing::Test {
 protected:
  /// Pushes a pair of frames, which the caps may contradict.
  void push(int width = 64, int height = 48) {
    const Pair pair = noise_pair(width, height, 4, 1);
    harness.push(Side::kLeft, frame_buffer(pair.left, 0, kFrame));
    harness.push(Side::kRight, frame_buffer(pair.right, 0, kFrame));
  }
  void expect_one_error(std::initializer_list<const char*> text,
                        std::initializer_list<const char*> details) {
    expect_one_error_of(harness, text, details);
  }
  static void expect_one_error_of(StereoHarness& harness, std::initializer_list<const char*> text,
                                  std::initializer_list<const char*> details) {
    const Report error = harness.error();
    ASSERT_NE(error.text, "") << "no error";
    for (const char* part : text) EXPECT_TRUE(has(error.text, part)) << part << "\n" << error.text;
    for (const char* part : details) {
      EXPECT_TRUE(has(error.details, part)) << part << "\n" << error.details;
    }
    EXPECT_EQ(harness.further_errors(), 0);
    EXPECT_EQ(harness.stats().pairs, 0u);
  }

  StereoHarness harness;
};

// Feature: different sizes are rejected
TEST_F(Refusal, ReportsDifferentSizes) {
  harness.caps(raw_caps("GRAY8", 64, 48), raw_caps("GRAY8", 32, 24));
  const Pair left = noise_pair(64, 48, 4, 1);
  const Pair right = noise_pair(32, 24, 4, 1);
  harness.push(Side::kLeft, frame_buffer(left.left, 0, kFrame));
  harness.push(Side::kRight, frame_buffer(right.right, 0, kFrame));
  expect_one_error({"left 64x48", "right 32x24"},
                   {"sink_left: GRAY8 64x48", "sink_right: GRAY8 32x24"});
}

TEST_F(Refusal, EndsTheStreamsAfterAnError) {
  harness.caps(raw_caps("GRAY8", 64, 48), raw_caps("GRAY8", 32, 24));
  push();
  ASSERT_NE(harness.error().text, "");
  EXPECT_TRUE(harness.pull_event(GST_EVENT_EOS));
  EXPECT_EQ(harness.push(Side::kLeft, frame_buffer(noise_pair(64, 48, 4, 1).left, 0, kFrame)),
            GST_FLOW_ERROR);
  EXPECT_EQ(harness.push(Side::kRight, frame_buffer(noise_pair(64, 48, 4, 1).left, 0, kFrame)),
            GST_FLOW_ERROR);
}

TEST_F(Refusal, AFlushClearsTheError) {
  harness.caps(raw_caps("GRAY8", 64, 48), raw_caps("GRAY8", 32, 24));
  push();
  ASSERT_NE(harness.error().text, "");
  ASSERT_TRUE(harness.pull_event(GST_EVENT_EOS));
  harness.flush(7);
  push();
  EXPECT_TRUE(has(harness.error().text, "different sizes")) << "the cause is still there";
  harness.flush(8);
  harness.caps(raw_caps("GRAY8", 64, 48));
  push();
  EXPECT_TRUE(harness.pull());
  EXPECT_EQ(harness.further_errors(), 0);
}

// Feature: interlaced video is rejected with a remedy
TEST_F(Refusal, ReportsInterlacedVideo) {
  harness.caps(raw_caps("GRAY8", 64, 48),
               raw_caps("GRAY8", 64, 48) + ",interlace-mode=interleaved");
  push();
  expect_one_error({"sink_right", "interlaced", "interleaved", "deinterlace"},
                   {"interlace-mode=(string)interleaved", "sink_left: GRAY8 64x48"});
}

TEST_F(Refusal, ReportsAnOffsetThatNoClockCanWaitFor) {
  for (const char* pad : {"sink_left", "sink_right"}) {
    for (const gint64 offset : {G_MAXINT64, gint64{4600000000000000000}, G_MININT64}) {
      StereoHarness offset_harness;
      GstPad* sink = gst_element_get_static_pad(offset_harness.element(), pad);
      gst_pad_set_offset(sink, offset);
      gst_object_unref(sink);
      offset_harness.caps(raw_caps("GRAY8", 64, 48));
      const Pair pair = noise_pair(64, 48, 4, 1);
      for (const Side side : {Side::kLeft, Side::kRight}) {
        offset_harness.push(side, frame_buffer(pair.left, 0, kFrame));
      }
      const std::string text = std::string(pad) + "::offset is " + std::to_string(offset);
      expect_one_error_of(offset_harness, {text.c_str(), "2305843009213693952"},
                          {"sink_left: GRAY8 64x48"});
    }
  }
}

// Feature: interlaced video is rejected with a remedy
TEST_F(Refusal, ReportsVideoThatMayBeInterlaced) {
  harness.caps(raw_caps("NV12", 64, 48) + ",interlace-mode=mixed", raw_caps("GRAY8", 64, 48));
  expect_one_error({"sink_left", "mixed", "deinterlace"}, {"NV12"});
}

class UnsupportedFormat : public Refusal, public testing::WithParamInterface<const char*> {};

TEST_P(UnsupportedFormat, IsReported) {
  harness.caps(raw_caps(GetParam(), 64, 48), raw_caps("GRAY8", 64, 48));
  expect_one_error({"sink_left", GetParam(), "videoconvert"}, {GetParam(), "GRAY8"});
}

INSTANTIATE_TEST_SUITE_P(Some, UnsupportedFormat,
                         testing::Values("NV12_64Z32", "NV12_4L4", "NV12_32L32", "RGB8P"),
                         [](const auto& info) { return std::string(info.param); });

TEST_F(Refusal, ReportsEncodedVideo) {
  harness.caps("video/x-h264,width=64,height=48", raw_caps("GRAY8", 64, 48));
  expect_one_error({"sink_left", "video/x-h264", "decode"}, {"video/x-h264"});
}

TEST_F(Refusal, ReportsGpuMemory) {
  harness.caps(raw_caps("GRAY8", 64, 48),
               "video/x-raw(memory:GLMemory),format=GRAY8,width=64,height=48");
  expect_one_error({"sink_right", "memory:GLMemory", "gldownload"}, {"GLMemory"});
}

TEST_F(Refusal, ReportsVideoOfAlternatingFields) {
  harness.caps(
      "video/x-raw(format:Interlaced),format=GRAY8,width=64,height=48,"
      "interlace-mode=alternate",
      raw_caps("GRAY8", 64, 48));
  expect_one_error({"sink_left", "alternate", "deinterlace"}, {"alternate"});
}

TEST_F(Refusal, ReportsCapsWithoutASize) {
  harness.caps("video/x-raw,format=GRAY8", raw_caps("GRAY8", 64, 48));
  expect_one_error({"sink_left", "width and height"}, {"GRAY8"});
}

TEST_F(Refusal, ReportsVideoWithoutPixels) {
  for (const auto& [width, height] : {std::pair{0, 0}, std::pair{0, 48}, std::pair{64, 0}}) {
    StereoHarness empty;
    empty.caps(raw_caps("GRAY8", width, height), raw_caps("GRAY8", 64, 48));
    const std::string size = std::to_string(width) + "x" + std::to_string(height) + " px";
    expect_one_error_of(empty, {"sink_left", size.c_str()}, {"GRAY8"});
  }
}

TEST_F(Refusal, ReportsVideoThatIsTooLarge) {
  harness.caps(raw_caps("GRAY8", 64, 48), raw_caps("GRAY8", 16385, 48));
  expect_one_error({"sink_right", "16385x48 px", "16384", "videoscale"}, {"GRAY8"});
}

// Feature: errors as messages with a remedy, no output on stdout
TEST_F(Refusal, ReportsTwoInvalidStreamsOnce) {
  harness.caps(raw_caps("RGB8P", 64, 48), raw_caps("NV12_4L4", 64, 48));
  push();
  expect_one_error({"videoconvert"}, {});
}

TEST_F(Refusal, ReportsABufferThatIsTooSmall) {
  harness.caps(raw_caps("GRAY8", 64, 48));
  harness.push(Side::kLeft, frame_buffer(noise_pair(64, 48, 4, 1).left, 0, kFrame));
  harness.push(Side::kRight, frame_buffer(noise_pair(64, 20, 4, 1).left, 0, kFrame));
  expect_one_error({"sink_right", "1280 bytes", "3072 bytes"}, {"64x48"});
}

/// Pushes a pair of 64x48 px whose left frame has a meta with these numbers.
void push_with_meta(StereoHarness& harness, guint width, guint height, gint row) {
  harness.caps(raw_caps("GRAY8", 64, 48));
  const Pair pair = noise_pair(64, 48, 4, 1);
  GstBuffer* left = frame_buffer(pair.left, 0, kFrame);
  gsize offset[GST_VIDEO_MAX_PLANES] = {0};
  gint stride[GST_VIDEO_MAX_PLANES] = {row};
  gst_buffer_add_video_meta_full(left, GST_VIDEO_FRAME_FLAG_NONE, GST_VIDEO_FORMAT_GRAY8, width,
                                 height, 1, offset, stride);
  harness.push(Side::kLeft, left);
  harness.push(Side::kRight, frame_buffer(pair.right, 0, kFrame));
}

TEST_F(Refusal, ReportsAMetaThatExceedsTheBuffer) {
  push_with_meta(harness, 64, 48, 1000);
  expect_one_error({"sink_left", "3072 bytes"}, {"64x48"});
}

TEST_F(Refusal, ReportsAMetaOfAnotherSize) {
  push_with_meta(harness, 48, 64, 48);
  expect_one_error({"sink_left", "48x64", "64x48"}, {});
}

TEST_F(Refusal, ReportsASearchRangeWiderThanTheFrame) {
  StereoHarness wide("max-disparity=100");
  wide.caps(raw_caps("GRAY8", 64, 48));
  wide.push_pair(noise_pair(64, 48, 4, 1), 0);
  expect_one_error_of(wide, {"max-disparity", "100", "64"}, {"max-disparity=100", "64x48"});
}

TEST_F(Refusal, ReportsCapsThatDownstreamDoesNotAccept) {
  gst_harness_set_sink_caps_str(harness.output(), "video/x-raw,format=GRAY16_LE,width=640");
  harness.caps(raw_caps("GRAY8", 64, 48));
  push();
  expect_one_error({"does not accept", "GRAY16_LE"}, {"width=(int)64", "width=(int)640"});
}

class StartFails : public testing::Test {
 protected:
  /// The error that an element with these properties posts when it is started.
  Report start(const std::string& properties) {
    GstElement* element = make_element(properties);
    GstBus* bus = gst_bus_new();
    gst_element_set_bus(element, bus);
    EXPECT_EQ(gst_element_set_state(element, GST_STATE_PAUSED), GST_STATE_CHANGE_FAILURE);
    Report report;
    int errors = 0;
    while (GstMessage* message = gst_bus_pop_filtered(bus, GST_MESSAGE_ERROR)) {
      GError* error = nullptr;
      gchar* details = nullptr;
      gst_message_parse_error(message, &error, &details);
      report = {error->message, details, error->domain, error->code};
      g_error_free(error);
      g_free(details);
      gst_message_unref(message);
      ++errors;
    }
    EXPECT_EQ(errors, 1);
    gst_element_set_state(element, GST_STATE_NULL);
    gst_element_set_bus(element, nullptr);
    gst_object_unref(bus);
    gst_object_unref(element);
    return report;
  }
};

// Feature: wrong values are explained
TEST_F(StartFails, IfDisparitiesExceedSixteenBits) {
  const Report error = start("max-disparity=300 disparity-scale=256");
  EXPECT_TRUE(has(error.text, "max-disparity")) << error.text;
  EXPECT_TRUE(has(error.text, "256")) << error.text;
  EXPECT_TRUE(has(error.details, "max-disparity=300")) << error.details;
  EXPECT_TRUE(has(error.details, "disparity-scale=256")) << error.details;
  EXPECT_EQ(error.domain, GST_LIBRARY_ERROR);
  EXPECT_EQ(error.code, GST_LIBRARY_ERROR_SETTINGS);
}

TEST_F(StartFails, IfNodeLevelsAreInvalid) {
  for (const char* levels : {"0,1", "2", "a", "1,,0", ""}) {
    const Report error = start(std::string("node-levels=") + levels);
    EXPECT_TRUE(has(error.text, "node-levels")) << error.text;
  }
}

TEST_F(StartFails, IfAKernelSizeIsEven) {
  const Report error = start("cost-kernel-size=4");
  EXPECT_TRUE(has(error.text, "cost-kernel-size")) << error.text;
  EXPECT_TRUE(has(error.text, "odd")) << error.text;
}

TEST_F(StartFails, ButNotAfterTheValueWasCorrected) {
  GstElement* element = make_element("cost-kernel-size=4 cost-kernel-size=5");
  EXPECT_NE(gst_element_set_state(element, GST_STATE_PAUSED), GST_STATE_CHANGE_FAILURE);
  gst_element_set_state(element, GST_STATE_NULL);
  gst_object_unref(element);
}

}  // namespace
}  // namespace mtstereo::test::error_test
