// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <array>

#include "support/pipeline.hpp"
#include "support/stereo_harness.hpp"

namespace mtstereo::test::mtcolor_test {
namespace {

using Color = std::array<int, 3>;
constexpr Color kBlack = {0, 0, 0};
constexpr Color kLast = {122, 4, 3};  // last color of Turbo

/// Colors rows of disparities by an mtcolor.
class ColorRow {
 public:
  ColorRow(const std::string& properties, const std::string& more_caps,
           const char* format = "RGB") {
    GstElement* element = make_element(properties, "mtcolor");
    harness_ = gst_harness_new_with_element(element, "sink", "src");
    gst_object_unref(element);
    element_ = element;
    format_ = gst_video_format_from_string(format);
    more_caps_ = more_caps;
  }
  ~ColorRow() { gst_harness_teardown(harness_); }
  ColorRow(const ColorRow&) = delete;
  ColorRow& operator=(const ColorRow&) = delete;

  GstElement* element() const { return element_; }
  void set_more_caps(const std::string& caps) { more_caps_ = caps; }

  /// The colors of these 16-bit values. Also sets fourth().
  std::vector<Color> colors(const std::vector<std::uint16_t>& values, int padding = 0) {
    const int width = static_cast<int>(values.size());
    gst_harness_set_src_caps_str(harness_, (raw_caps("GRAY16_LE", width, 2) + more_caps_).c_str());
    gst_harness_set_sink_caps_str(
        harness_,
        (std::string("video/x-raw,format=") + gst_video_format_to_string(format_)).c_str());
    const int stride = GST_ROUND_UP_4(2 * width) + padding;
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(stride) * 2, 0xAB);
    for (int y = 0; y < 2; ++y) {
      for (int x = 0; x < width; ++x) {
        GST_WRITE_UINT16_LE(bytes.data() + y * stride + 2 * x, values[static_cast<std::size_t>(x)]);
      }
    }
    GstBuffer* buffer = gst_buffer_new_memdup(bytes.data(), bytes.size());
    gsize offsets[GST_VIDEO_MAX_PLANES] = {0};
    gint strides[GST_VIDEO_MAX_PLANES] = {stride};
    gst_buffer_add_video_meta_full(buffer, GST_VIDEO_FRAME_FLAG_NONE, GST_VIDEO_FORMAT_GRAY16_LE,
                                   static_cast<guint>(width), 2, 1, offsets, strides);
    GST_BUFFER_PTS(buffer) = 0;
    const BufferPointer out(gst_harness_push_and_pull(harness_, buffer));
    return read(out.get(), width);
  }
  /// The fourth byte of every pixel; empty for 3-byte formats.
  const std::vector<int>& fourth() const { return fourth_; }

 private:
  std::vector<Color> read(GstBuffer* buffer, int width) {
    std::vector<Color> result;
    GstVideoInfo info;
    gst_video_info_set_format(&info, format_, static_cast<guint>(width), 2);
    GstVideoFrame frame;
    if (buffer == nullptr || !gst_video_frame_map(&frame, &info, buffer, GST_MAP_READ)) {
      ADD_FAILURE() << "no image";
      return result;
    }
    fourth_.clear();
    const auto* row = static_cast<const guint8*>(GST_VIDEO_FRAME_PLANE_DATA(&frame, 0)) +
                      GST_VIDEO_FRAME_PLANE_STRIDE(&frame, 0);
    const int step = GST_VIDEO_FRAME_COMP_PSTRIDE(&frame, 0);
    for (int x = 0; x < width; ++x, row += step) {
      Color color;
      int used = 0;
      for (std::size_t part = 0; part < 3; ++part) {
        const int at = GST_VIDEO_FRAME_COMP_POFFSET(&frame, part);
        color[part] = row[at];
        used += at;
      }
      result.push_back(color);
      if (step == 4) fourth_.push_back(row[6 - used]);
    }
    gst_video_frame_unmap(&frame);
    return result;
  }

  GstHarness* harness_ = nullptr;
  GstElement* element_ = nullptr;
  GstVideoFormat format_ = GST_VIDEO_FORMAT_UNKNOWN;
  std::string more_caps_;
  std::vector<int> fourth_;
};

// Feature: color preview with a fixed range
TEST(Color, NoDisparityIsBlackAndTheEndOfTheRangeIsRed) {
  ColorRow row("max-disparity=32", ",disparity-scale=256");
  const auto colors = row.colors({0, 1, 32 * 256, 65535});
  EXPECT_EQ(colors[0], kBlack);
  EXPECT_NE(colors[1], kBlack);
  EXPECT_EQ(colors[2], kLast);
  EXPECT_EQ(colors[3], kLast);
}

TEST(Color, CapsOverrideTheScaleProperty) {
  ColorRow row("max-disparity=32 disparity-scale=256", ",disparity-scale=16");
  const auto colors = row.colors({31 * 16 / 2, 32 * 16});
  EXPECT_NE(colors[0], kLast);
  EXPECT_EQ(colors[1], kLast);
}

TEST(Color, ScalePropertyAppliesIfTheCapsHaveNoScale) {
  ColorRow row("max-disparity=32 disparity-scale=16", "");
  EXPECT_EQ(row.colors({32 * 16, 1})[0], kLast);
  ColorRow standard("max-disparity=32", "");
  EXPECT_NE(standard.colors({32 * 16, 1})[0], kLast);
  EXPECT_EQ(standard.colors({32 * 256, 1})[0], kLast);
}

TEST(Color, RangeComesFromTheCapsUnlessSet) {
  ColorRow automatic("", ",disparity-scale=256,max-disparity=20");
  EXPECT_EQ(automatic.colors({20 * 256, 1})[0], kLast);
  EXPECT_NE(automatic.colors({15 * 256, 1})[0], kLast);
  ColorRow set("max-disparity=100", ",disparity-scale=256,max-disparity=20");
  EXPECT_NE(set.colors({20 * 256, 1})[0], kLast);
  ColorRow unknown("", "");
  EXPECT_EQ(unknown.colors({64 * 256, 1})[0], kLast);
  EXPECT_NE(unknown.colors({50 * 256, 1})[0], kLast);
}

TEST(Color, RangeBeginsAtTheOffsetOfTheCaps) {
  ColorRow row("max-disparity=32", ",disparity-scale=256,disparity-offset=-16");
  EXPECT_EQ(row.colors({48 * 256, 1})[0], kLast);
  EXPECT_NE(row.colors({40 * 256, 1})[0], kLast);
  row.set_more_caps(",disparity-scale=256");
  EXPECT_EQ(row.colors({32 * 256, 1})[0], kLast) << "the offset of the stream before";
}

// Feature: color preview with a fixed range
TEST(Color, RangeDoesNotDependOnTheFrame) {
  ColorRow row("max-disparity=64", ",disparity-scale=256");
  const auto alone = row.colors({10 * 256, 10 * 256, 10 * 256});
  const auto beside = row.colors({10 * 256, 1, 65535});
  EXPECT_EQ(alone[0], beside[0]);
}

TEST(Color, RangeCanBeChangedWhilePlaying) {
  ColorRow row("max-disparity=64", ",disparity-scale=256");
  EXPECT_NE(row.colors({32 * 256, 1})[0], kLast);
  g_object_set(row.element(), "max-disparity", 32, nullptr);
  EXPECT_EQ(row.colors({32 * 256, 1})[0], kLast);
}

TEST(Color, PaddingIsIgnored) {
  ColorRow row("max-disparity=32", ",disparity-scale=256");
  for (const int padding : {0, 4, 32}) {
    const auto colors = row.colors({0, 32 * 256, 0, 32 * 256, 0}, padding);
    EXPECT_EQ(colors, (std::vector<Color>{kBlack, kLast, kBlack, kLast, kBlack})) << padding;
  }
}

class ColorFormat : public testing::TestWithParam<const char*> {};

// Feature: color preview with a fixed range
TEST_P(ColorFormat, HasTheSameColors) {
  const std::vector<std::uint16_t> values = {0, 256, 10 * 256, 32 * 256, 5 * 256};
  ColorRow rgb("max-disparity=32", ",disparity-scale=256");
  ColorRow other("max-disparity=32", ",disparity-scale=256", GetParam());
  EXPECT_EQ(rgb.colors(values), other.colors(values));
  for (const int fourth : other.fourth()) EXPECT_EQ(fourth, 255);
}

INSTANTIATE_TEST_SUITE_P(All, ColorFormat,
                         testing::Values("RGB", "BGR", "RGBx", "BGRx", "xRGB", "xBGR", "RGBA",
                                         "BGRA", "ARGB", "ABGR"),
                         [](const auto& info) { return std::string(info.param); });

TEST(Color, ReportsInvalidCaps) {
  Pipeline pipeline(
      "videotestsrc num-buffers=1 ! video/x-raw,format=GRAY8 ! videoconvert ! "
      "video/x-raw,format=GRAY16_LE ! capssetter caps=video/x-raw,disparity-scale=0 ! "
      "mtcolor ! fakesink");
  const std::string error = pipeline.run();
  EXPECT_NE(error.find("disparity-scale=0"), std::string::npos) << error;
}

/// The error of mtcolor for a 64x48 frame whose video meta has these values.
std::string error_of_frame(GstVideoFormat format, guint width, gint stride, gsize bytes) {
  Pipeline pipeline("appsrc name=in is-live=false format=time caps=" +
                    raw_caps("GRAY16_LE", 64, 48) + " ! mtcolor ! fakesink");
  pipeline.set_state(GST_STATE_PLAYING);
  GstBuffer* buffer = gst_buffer_new_allocate(nullptr, bytes, nullptr);
  gst_buffer_memset(buffer, 0, 1, bytes);
  gsize offsets[GST_VIDEO_MAX_PLANES] = {0};
  gint strides[GST_VIDEO_MAX_PLANES] = {stride};
  gst_buffer_add_video_meta_full(buffer, GST_VIDEO_FRAME_FLAG_NONE, format, width, 48, 1, offsets,
                                 strides);
  GstFlowReturn flow = GST_FLOW_OK;
  g_signal_emit_by_name(pipeline.named("in"), "push-buffer", buffer, &flow);
  gst_buffer_unref(buffer);
  g_signal_emit_by_name(pipeline.named("in"), "end-of-stream", &flow);
  return pipeline.wait_for_end();
}

TEST(Color, ReportsFramesThatContradictTheirCaps) {
  constexpr auto kGray16 = GST_VIDEO_FORMAT_GRAY16_LE;
  EXPECT_EQ(error_of_frame(kGray16, 64, 128, 128 * 48), "");
  const std::string rows = error_of_frame(kGray16, 64, 256, 128 * 48);
  EXPECT_NE(rows.find("6144 bytes, the frame needs 12160 bytes"), std::string::npos) << rows;
  const std::string size = error_of_frame(kGray16, 32, 128, 128 * 48);
  EXPECT_NE(size.find("32x48"), std::string::npos) << size;
  const std::string format = error_of_frame(GST_VIDEO_FORMAT_GRAY8, 64, 128, 128 * 48);
  EXPECT_NE(format.find("GRAY8 64x48"), std::string::npos) << format;
}

TEST(Color, AcceptsTheOutputOfMtstereo) {
  Pipeline pipeline(
      "videotestsrc num-buffers=3 pattern=smpte ! "
      "video/x-raw,format=GRAY8,width=160,height=120 ! tee name=t "
      "mtstereo name=m max-disparity=32 ! mtcolor ! video/x-raw,format=BGRx ! "
      "appsink name=out wait-on-eos=false sync=false t. ! queue ! m.sink_left "
      "t. ! queue ! videobox left=4 right=-4 ! m.sink_right");
  EXPECT_EQ(pipeline.run(), "");
  const auto samples = pipeline.samples();
  ASSERT_EQ(samples.size(), 3u);
  EXPECT_EQ(samples[0].bytes.size(), 160u * 120 * 4);
  EXPECT_EQ(samples[0].caps.find("disparity-scale"), std::string::npos) << samples[0].caps;
}

}  // namespace
}  // namespace mtstereo::test::mtcolor_test
