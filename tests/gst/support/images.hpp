// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/video/video.h>

#include <cstdint>
#include <string>
#include <vector>

#include "mtstereo/parameters.hpp"

namespace mtstereo::test {

/// An 8-bit image without padding.
struct GrayImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;
};

/// A rectified pair with a uniform disparity.
struct Pair {
  GrayImage left;
  GrayImage right;
};

/// A pair of smooth noise images, shifted by `disparity` px. The image depends on the seed.
Pair noise_pair(int width, int height, int disparity, unsigned seed);

/// Raw caps of a format: "video/x-raw,format=GRAY8,width=...", 30/1 fps by default.
std::string raw_caps(const char* format, int width, int height, const char* framerate = "30/1");

/// The format and memory layout of a frame.
struct Layout {
  const char* format = "GRAY8";
  int padding = 0;          ///< after each row of the first plane [bytes]
  int offset = 0;           ///< of the first row [bytes]
  std::uint8_t poison = 0;  ///< value of all other bytes, chroma planes included
};

/// A frame with this image as luma. With padding or offset it has a GstVideoMeta. The times are in
/// ns or GST_CLOCK_TIME_NONE.
GstBuffer* frame_buffer(const GrayImage& image, GstClockTime pts, GstClockTime duration,
                        const Layout& layout = {});

/// The disparity map of the library: 16-bit fixed point, row by row.
std::vector<std::uint16_t> library_map(const Pair& pair, const Parameters& parameters, int scale);

/// The confidence map of the library, row by row.
std::vector<std::uint8_t> library_confidence(const Pair& pair, const Parameters& parameters);

/// The confidence map of a disparity map, row by row; empty if it has none.
std::vector<std::uint8_t> confidence_of(GstBuffer* disparity);

/// The pixels of a GRAY16_LE buffer of this size, row by row.
std::vector<std::uint16_t> map_of(GstBuffer* buffer, int width, int height);

/// "" if both are equal, otherwise the position of the first difference and the number of
/// differences.
std::string first_difference(const std::vector<std::uint16_t>& expected,
                             const std::vector<std::uint16_t>& actual, int width);

}  // namespace mtstereo::test
