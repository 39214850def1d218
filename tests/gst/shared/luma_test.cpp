// SPDX-License-Identifier: LGPL-2.1-or-later
// Formats whose luma is converted to 8 bits.
#include "shared/luma.hpp"

#include <gtest/gtest.h>

#include <random>

#include "support/pipeline.hpp"
#include "support/stereo_harness.hpp"

namespace mtstereo::test::luma_test {
namespace {

using plugin::has_luma_plane;
using plugin::is_readable;
using plugin::LumaReader;
using plugin::MappedFrame;

Parameters small_range() {
  Parameters parameters;
  EXPECT_TRUE(parameters.set(Parameter::kMaxDisparity, 16).ok());
  return parameters;
}

GstVideoInfo info_of(const char* format, int width, int height) {
  GstVideoInfo info;
  EXPECT_TRUE(gst_video_info_set_format(&info, gst_video_format_from_string(format),
                                        static_cast<guint>(width), static_cast<guint>(height)));
  return info;
}

GstBuffer* stamped(GstBuffer* buffer) {
  GST_BUFFER_PTS(buffer) = 0;
  GST_BUFFER_DURATION(buffer) = kFrame;
  return buffer;
}

std::vector<std::uint8_t> noise(std::size_t size) {
  std::mt19937 random(3);
  std::vector<std::uint8_t> bytes(size);
  for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
  return bytes;
}

/// A frame in which every byte that is not luma is noise. The luma is the high byte at `first` and
/// every `step` bytes. Rows are `padding` bytes longer than necessary; row 0 starts at `offset`.
GstBuffer* noisy_frame(const GrayImage& image, const char* format, int first, int step,
                       int padding = 0, int offset = 0) {
  GstVideoInfo info = info_of(format, image.width, image.height);
  const int grown = offset + padding * image.height;
  info.stride[0] += padding;
  info.offset[0] += static_cast<gsize>(offset);
  for (guint plane = 1; plane < GST_VIDEO_INFO_N_PLANES(&info); ++plane) {
    info.offset[plane] += static_cast<gsize>(grown);
  }
  std::vector<std::uint8_t> bytes = noise(info.size + static_cast<gsize>(grown));
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      bytes[info.offset[0] + static_cast<gsize>(y * info.stride[0] + x * step + first)] =
          image.pixels[static_cast<std::size_t>(y * image.width + x)];
    }
  }
  GstBuffer* buffer = gst_buffer_new_memdup(bytes.data(), bytes.size());
  if (grown != 0) {
    gst_buffer_add_video_meta_full(buffer, GST_VIDEO_FRAME_FLAG_NONE, GST_VIDEO_INFO_FORMAT(&info),
                                   static_cast<guint>(image.width),
                                   static_cast<guint>(image.height), GST_VIDEO_INFO_N_PLANES(&info),
                                   info.offset, info.stride);
  }
  return stamped(buffer);
}

/// A frame that GStreamer converted from GRAY8.
GstBuffer* converted_frame(const GrayImage& image, const char* format) {
  GstVideoInfo from = info_of("GRAY8", image.width, image.height);
  GstVideoInfo to = info_of(format, image.width, image.height);
  if (!GST_VIDEO_INFO_IS_RGB(&to)) from.colorimetry = to.colorimetry;
  GstBuffer* gray = gst_buffer_new_allocate(nullptr, from.size, nullptr);
  GstBuffer* buffer = gst_buffer_new_allocate(nullptr, to.size, nullptr);
  GstVideoFrame source, target;
  EXPECT_TRUE(gst_video_frame_map(&source, &from, gray, GST_MAP_WRITE));
  EXPECT_TRUE(gst_video_frame_map(&target, &to, buffer, GST_MAP_WRITE));
  for (int y = 0; y < image.height; ++y) {
    std::copy_n(image.pixels.begin() + y * image.width, image.width, plugin::plane_row(source, y));
  }
  GstVideoConverter* converter = gst_video_converter_new(
      &from, &to,
      gst_structure_new("options", GST_VIDEO_CONVERTER_OPT_DITHER_METHOD,
                        GST_TYPE_VIDEO_DITHER_METHOD, GST_VIDEO_DITHER_NONE, nullptr));
  gst_video_converter_frame(converter, &source, &target);
  gst_video_converter_free(converter);
  gst_video_frame_unmap(&source);
  gst_video_frame_unmap(&target);
  gst_buffer_unref(gray);
  return stamped(buffer);
}

/// Pushes a pair and compares the map with that of the same luma in GRAY8.
void expect_map_of_gray8(const Pair& pair, const std::string& caps, GstBuffer* left,
                         GstBuffer* right) {
  StereoHarness harness;
  harness.caps(caps);
  harness.push(Side::kLeft, left);
  harness.push(Side::kRight, right);
  const BufferPointer map = harness.pull();
  ASSERT_TRUE(map) << harness.error(1).text;
  const int width = pair.left.width;
  EXPECT_EQ(first_difference(library_map(pair, small_range(), 256),
                             map_of(map.get(), width, pair.left.height), width),
            "")
      << caps;
}

// --- bytes of the luma ---

struct Bytes {
  const char* format;
  int first;
  int step;
};

class StoredLuma : public testing::TestWithParam<Bytes> {};

// Feature: gray and YUV of 10 to 16 bits
TEST_P(StoredLuma, IsReadByItsHighestBitsAtEverySizeAndStride) {
  const auto [format, first, step] = GetParam();
  for (const auto& [width, height] : {std::pair(64, 48), {61, 47}, {33, 17}, {17, 1}}) {
    const Pair pair = noise_pair(width, height, 3, 9);
    for (const auto& [padding, offset] : {std::pair(0, 0), {16, 0}, {14, 0}, {1, 37}, {5, 2}}) {
      expect_map_of_gray8(pair, raw_caps(format, width, height),
                          noisy_frame(pair.left, format, first, step, padding, offset),
                          noisy_frame(pair.right, format, first, step, padding, offset));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, StoredLuma,
                         testing::Values(Bytes{"YUY2", 0, 2}, Bytes{"YVYU", 0, 2},
                                         Bytes{"UYVY", 1, 2}, Bytes{"VYUY", 1, 2},
                                         Bytes{"AYUV", 1, 4}, Bytes{"VUYA", 2, 4},
                                         Bytes{"AYUV64", 3, 8}, Bytes{"Y210", 1, 4},
                                         Bytes{"v308", 0, 3}, Bytes{"GRAY16_LE", 1, 2},
                                         Bytes{"GRAY16_BE", 0, 2}, Bytes{"P010_10LE", 1, 2},
                                         Bytes{"P012_LE", 1, 2}, Bytes{"P016_LE", 1, 2}),
                         [](const auto& info) { return std::string(info.param.format); });

TEST(StoredLuma, IsReadAsItIsWhateverItsRange) {
  const Pair pair = noise_pair(64, 48, 3, 9);
  for (const char* colorimetry : {"1:4:0:0", "2:4:0:0", "bt709", "bt2020"}) {
    expect_map_of_gray8(pair, raw_caps("YUY2", 64, 48) + ",colorimetry=" + colorimetry,
                        noisy_frame(pair.left, "YUY2", 0, 2),
                        noisy_frame(pair.right, "YUY2", 0, 2));
  }
}

// --- every format ---

std::vector<std::string> readable_formats() {
  std::vector<std::string> names;
  guint count = 0;
  const GstVideoFormat* formats = gst_video_formats_raw(&count);
  for (guint i = 0; i < count; ++i) {
    if (is_readable(formats[i])) names.emplace_back(gst_video_format_to_string(formats[i]));
  }
  return names;
}

bool is_rgb(const std::string& format) {
  return GST_VIDEO_FORMAT_INFO_IS_RGB(
      gst_video_format_get_info(gst_video_format_from_string(format.c_str())));
}

// Feature: packed 4:2:2 as webcams send it
TEST(Luma, OfEveryYuvAndGrayFormatHasTheMapOfGray8) {
  const Pair pair = noise_pair(96, 64, 5, 8);
  for (const std::string& format : readable_formats()) {
    if (is_rgb(format)) continue;
    expect_map_of_gray8(pair, raw_caps(format.c_str(), 96, 64),
                        converted_frame(pair.left, format.c_str()),
                        converted_frame(pair.right, format.c_str()));
  }
}

// Feature: RGB input
TEST(Luma, OfGrayInEveryRgbFormatIsNearThatOfGray8) {
  const GrayImage image = noise_pair(64, 48, 3, 1).left;
  int formats = 0;
  for (const std::string& format : readable_formats()) {
    if (!is_rgb(format)) continue;
    ++formats;
    const GstVideoInfo info = info_of(format.c_str(), 64, 48);
    const BufferPointer buffer(converted_frame(image, format.c_str()));
    const MappedFrame frame(info, buffer.get(), GST_MAP_READ);
    ASSERT_TRUE(frame.mapped());
    LumaReader reader;
    const GrayView luma = reader.read(frame);
    const int rounding = GST_VIDEO_INFO_COMP_DEPTH(&info, 0) < 8 ? 8 : 1;
    for (int i = 0; i < 64 * 48; ++i) {
      ASSERT_NEAR(luma.row(i / 64)[i % 64], image.pixels[static_cast<std::size_t>(i)], rounding)
          << format;
    }
  }
  EXPECT_GT(formats, 20);
}

// Feature: RGB input
TEST(Luma, OfRgbHasTheWeightsOfBt601) {
  const std::vector<std::uint8_t> rgb = {200, 0, 0, 0, 0, 200, 0, 0, 0, 0, 200, 0};
  const GstVideoInfo info = info_of("RGBx", 3, 1);
  const BufferPointer buffer(gst_buffer_new_memdup(rgb.data(), rgb.size()));
  const MappedFrame frame(info, buffer.get(), GST_MAP_READ);
  ASSERT_TRUE(frame.mapped());
  LumaReader reader;
  const GrayView luma = reader.read(frame);
  EXPECT_NEAR(luma.row(0)[0], 0.299 * 200, 1);
  EXPECT_NEAR(luma.row(0)[1], 0.587 * 200, 1);
  EXPECT_NEAR(luma.row(0)[2], 0.114 * 200, 1);
}

// --- the reader ---

TEST(LumaReading, UsesOneBufferForAllFrames) {
  const GrayImage image = noise_pair(64, 48, 3, 1).left;
  const GstVideoInfo info = info_of("YUY2", 64, 48);
  LumaReader reader;
  const std::uint8_t* first = nullptr;
  for (int i = 0; i < 3; ++i) {
    const BufferPointer buffer(noisy_frame(image, "YUY2", 0, 2));
    const MappedFrame frame(info, buffer.get(), GST_MAP_READ);
    const GrayView luma = reader.read(frame);
    if (i == 0) first = luma.data;
    EXPECT_EQ(luma.data, first);
  }
}

TEST(LumaReading, TakesALumaPlaneInPlace) {
  const GrayImage image = noise_pair(64, 48, 3, 1).left;
  for (const char* format : {"GRAY8", "I420", "NV12", "Y42B"}) {
    const GstVideoInfo info = info_of(format, 64, 48);
    const BufferPointer buffer(frame_buffer(image, 0, kFrame, {.format = format}));
    const MappedFrame frame(info, buffer.get(), GST_MAP_READ);
    LumaReader reader;
    EXPECT_EQ(reader.read(frame).data, frame.luma().data) << format;
  }
}

TEST(LumaReading, PrefersFormatsInPlace) {
  const std::string list = plugin::luma_formats();
  EXPECT_EQ(list.rfind("{ GRAY8,", 0), 0u);
  for (const char* in_place : {" I420,", " NV12,", " Y42B,"}) {
    for (const char* converted : {" YUY2,", " UYVY,", " RGB,", " I420_10LE,", " GRAY16_LE,"}) {
      EXPECT_LT(list.find(in_place), list.find(converted)) << in_place << converted;
    }
  }
  EXPECT_LT(list.find(" YUY2,"), list.find(" RGB,"));
  EXPECT_EQ(list.find("_4L4"), std::string::npos) << "tiled";
}

TEST(LumaReading, FollowsChangesOfFormatAndSize) {
  StereoHarness harness;
  GstClockTime time = 0;
  for (const auto& [format, width] : {std::pair("GRAY8", 64),
                                      {"YUY2", 64},
                                      {"RGB", 64},
                                      {"RGB", 96},
                                      {"YUY2", 32},
                                      {"I420", 32}}) {
    const Pair pair = noise_pair(width, 48, 3, 9);
    harness.caps(raw_caps(format, width, 48), raw_caps("GRAY8", width, 48));
    GstBuffer* left = converted_frame(pair.left, format);
    GST_BUFFER_PTS(left) = time;
    harness.push(Side::kLeft, left);
    harness.push(Side::kRight, frame_buffer(pair.right, time, kFrame));
    time += kFrame;
    const BufferPointer map = harness.pull();
    ASSERT_TRUE(map) << harness.error(1).text;
    EXPECT_EQ(first_difference(library_map(pair, small_range(), 256), map_of(map.get(), width, 48),
                               width),
              "")
        << format << " " << width;
  }
}

// --- invalid frames ---

struct BadMeta {
  const char* format;
  guint plane;
  gsize offset;
  int stride;
  const char* reported;
};

class InvalidFrame : public testing::TestWithParam<BadMeta> {};

TEST_P(InvalidFrame, IsRefused) {
  const auto [format, plane, offset, stride, reported] = GetParam();
  const Pair pair = noise_pair(64, 48, 3, 9);
  GstVideoInfo info = info_of(format, 64, 48);
  info.offset[plane] = offset;
  info.stride[plane] = stride;
  GstBuffer* left = converted_frame(pair.left, format);
  gst_buffer_add_video_meta_full(left, GST_VIDEO_FRAME_FLAG_NONE, GST_VIDEO_INFO_FORMAT(&info), 64,
                                 48, GST_VIDEO_INFO_N_PLANES(&info), info.offset, info.stride);
  StereoHarness harness;
  harness.caps(raw_caps(format, 64, 48));
  harness.push(Side::kLeft, left);
  harness.push(Side::kRight, converted_frame(pair.right, format));
  const Report error = harness.error();
  EXPECT_NE(error.text.find("sink_left"), std::string::npos) << error.text;
  EXPECT_NE(error.text.find(reported), std::string::npos) << error.text;
  EXPECT_EQ(harness.further_errors(0), 0);
}

INSTANTIATE_TEST_SUITE_P(Some, InvalidFrame,
                         testing::Values(BadMeta{"YUY2", 0, 0, 100, "a row needs 128 bytes"},
                                         BadMeta{"YUY2", 0, 1000, 128, "the frame needs"},
                                         BadMeta{"RGB", 0, 0, 191, "a row needs 192 bytes"},
                                         BadMeta{"v210", 0, 0, 128, "a row needs"},
                                         BadMeta{"I420_10LE", 1, 9000, 64, "the frame needs"},
                                         BadMeta{"I420_10LE", 2, 8000, 62, "a row needs 64"},
                                         BadMeta{"P010_10LE", 1, 6144, 126, "a row needs 128"}));

TEST(InvalidFrame, ThatIsTooSmallIsRefused) {
  const Pair pair = noise_pair(64, 48, 3, 9);
  StereoHarness harness;
  harness.caps(raw_caps("YUY2", 64, 48), raw_caps("GRAY8", 64, 48));
  harness.push(Side::kLeft, frame_buffer(pair.left, 0, kFrame));
  harness.push(Side::kRight, frame_buffer(pair.right, 0, kFrame));
  const Report error = harness.error();
  EXPECT_NE(error.text.find("sink_left"), std::string::npos) << error.text;
  EXPECT_NE(error.text.find("6144 bytes"), std::string::npos) << error.text;
}

// --- links ---

// Feature: packed 4:2:2 as webcams send it
TEST(Link, OfACameraWithYuy2NeedsNoConversion) {
  for (const char* format : {"YUY2", "UYVY", "BGRx", "RGB", "GRAY16_LE", "P010_10LE"}) {
    const std::string source = std::string("videotestsrc num-buffers=2 ! video/x-raw,format=") +
                               format + ",width=64,height=48 ! m.sink_";
    Pipeline pipeline("mtstereo name=m max-disparity=16 ! fakesink  " + source + "left  " + source +
                      "right");
    EXPECT_EQ(pipeline.run(), "") << format;
  }
}

}  // namespace
}  // namespace mtstereo::test::luma_test
