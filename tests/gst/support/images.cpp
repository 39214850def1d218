// SPDX-License-Identifier: LGPL-2.1-or-later
#include "support/images.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>

#include "mtstereo/mtstereo.hpp"
#include "support/confidence_reader.h"

namespace mtstereo::test {

Pair noise_pair(int width, int height, int disparity, unsigned seed) {
  std::mt19937 random(seed);
  const int wide = width + disparity + 4;
  std::vector<int> noise(static_cast<std::size_t>(wide));
  Pair pair;
  pair.left = {width, height, {}};
  pair.right = {width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int& value : noise) value = static_cast<int>(random() % 256);
    // Smoothed over 5 px, so that a scan-line has gradual slopes.
    const auto at = [&](int x) {
      int sum = 0;
      for (int i = 0; i < 5; ++i) sum += noise[static_cast<std::size_t>(std::min(x + i, wide - 1))];
      return static_cast<std::uint8_t>(sum / 5);
    };
    for (int x = 0; x < width; ++x) {
      pair.left.pixels.push_back(at(x));
      pair.right.pixels.push_back(at(x + disparity));
    }
  }
  return pair;
}

std::string raw_caps(const char* format, int width, int height, const char* framerate) {
  return std::string("video/x-raw,format=") + format + ",width=" + std::to_string(width) +
         ",height=" + std::to_string(height) + ",framerate=" + framerate;
}

GstBuffer* frame_buffer(const GrayImage& image, GstClockTime pts, GstClockTime duration,
                        const Layout& layout) {
  GstVideoInfo info;
  gst_video_info_set_format(&info, gst_video_format_from_string(layout.format),
                            static_cast<guint>(image.width), static_cast<guint>(image.height));
  const bool padded = layout.padding != 0 || layout.offset != 0;
  if (padded) {
    const gsize grown = static_cast<gsize>(layout.offset) +
                        static_cast<gsize>(layout.padding) * static_cast<gsize>(image.height);
    info.stride[0] += layout.padding;
    info.offset[0] = static_cast<gsize>(layout.offset);
    for (guint plane = 1; plane < GST_VIDEO_INFO_N_PLANES(&info); ++plane) {
      info.offset[plane] += grown;
    }
    info.size += grown;
  }
  std::vector<std::uint8_t> bytes(info.size, layout.poison);
  for (int y = 0; y < image.height; ++y) {
    std::copy_n(image.pixels.begin() + static_cast<std::ptrdiff_t>(y) * image.width, image.width,
                bytes.begin() + static_cast<std::ptrdiff_t>(info.offset[0]) +
                    static_cast<std::ptrdiff_t>(y) * info.stride[0]);
  }
  GstBuffer* buffer = gst_buffer_new_memdup(bytes.data(), bytes.size());
  if (padded) {
    gst_buffer_add_video_meta_full(buffer, GST_VIDEO_FRAME_FLAG_NONE, GST_VIDEO_INFO_FORMAT(&info),
                                   static_cast<guint>(image.width),
                                   static_cast<guint>(image.height), GST_VIDEO_INFO_N_PLANES(&info),
                                   info.offset, info.stride);
  }
  GST_BUFFER_PTS(buffer) = pts;
  GST_BUFFER_DURATION(buffer) = duration;
  return buffer;
}

namespace {

/// A matcher and its result for a pair.
struct Matched {
  std::optional<Matcher> matcher;
  FrameResult result;
};

Matched match(const Pair& pair, const Parameters& parameters) {
  const auto view = [](const GrayImage& image) {
    return GrayView{image.pixels.data(), image.width, image.height, image.width};
  };
  auto matcher = Matcher::create(parameters);
  if (!matcher) {
    ADD_FAILURE() << matcher.error().message;
    return {};
  }
  const auto result = matcher->compute(view(pair.left), view(pair.right));
  if (!result) {
    ADD_FAILURE() << result.error().message;
    return {};
  }
  return {std::move(matcher.value()), *result};
}

}  // namespace

std::vector<std::uint16_t> library_map(const Pair& pair, const Parameters& parameters, int scale) {
  std::vector<std::uint16_t> values(pair.left.pixels.size());
  const Matched matched = match(pair, parameters);
  if (!matched.matcher) return values;
  const Status written =
      write_disparity16(matched.result.disparity, scale,
                        {values.data(), pair.left.width, pair.left.height, pair.left.width * 2});
  EXPECT_TRUE(written.ok());
  return values;
}

std::vector<std::uint8_t> library_confidence(const Pair& pair, const Parameters& parameters) {
  std::vector<std::uint8_t> values;
  const Matched matched = match(pair, parameters);
  if (!matched.matcher) return values;
  const GrayView& view = matched.result.confidence;
  for (int y = 0; y < view.height; ++y) {
    values.insert(values.end(), view.row(y), view.row(y) + view.width);
  }
  return values;
}

std::vector<std::uint8_t> confidence_of(GstBuffer* disparity) {
  std::vector<std::uint8_t> values;
  GstVideoFrame frame;
  if (!map_confidence(disparity, &frame)) return values;
  for (int y = 0; y < GST_VIDEO_FRAME_HEIGHT(&frame); ++y) {
    const auto* row = static_cast<const guint8*>(GST_VIDEO_FRAME_PLANE_DATA(&frame, 0)) +
                      static_cast<gssize>(y) * GST_VIDEO_FRAME_PLANE_STRIDE(&frame, 0);
    values.insert(values.end(), row, row + GST_VIDEO_FRAME_WIDTH(&frame));
  }
  gst_video_frame_unmap(&frame);
  return values;
}

std::vector<std::uint16_t> map_of(GstBuffer* buffer, int width, int height) {
  GstVideoInfo info;
  gst_video_info_set_format(&info, GST_VIDEO_FORMAT_GRAY16_LE, static_cast<guint>(width),
                            static_cast<guint>(height));
  std::vector<std::uint16_t> values;
  GstVideoFrame frame;
  if (!gst_video_frame_map(&frame, &info, buffer, GST_MAP_READ)) {
    ADD_FAILURE() << "the disparity map cannot be mapped as " << width << "x" << height;
    return values;
  }
  for (int y = 0; y < height; ++y) {
    const auto* row = static_cast<const guint8*>(GST_VIDEO_FRAME_PLANE_DATA(&frame, 0)) +
                      static_cast<gssize>(y) * GST_VIDEO_FRAME_PLANE_STRIDE(&frame, 0);
    for (int x = 0; x < width; ++x) {  // the address may be odd
      values.push_back(static_cast<std::uint16_t>(row[2 * x] | row[2 * x + 1] << 8));
    }
  }
  gst_video_frame_unmap(&frame);
  return values;
}

std::string first_difference(const std::vector<std::uint16_t>& expected,
                             const std::vector<std::uint16_t>& actual, int width) {
  if (expected.size() != actual.size()) {
    return "sizes differ: " + std::to_string(expected.size()) + " and " +
           std::to_string(actual.size());
  }
  std::string where;
  int count = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (expected[i] == actual[i]) continue;
    if (count++ == 0) {
      const int at = static_cast<int>(i);
      where = "first at (" + std::to_string(at % width) + ", " + std::to_string(at / width) +
              "): expected " + std::to_string(expected[i]) + ", got " + std::to_string(actual[i]);
    }
  }
  return count == 0 ? "" : where + "; " + std::to_string(count) + " pixels differ";
}

}  // namespace mtstereo::test
