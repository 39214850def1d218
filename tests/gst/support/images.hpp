// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/video/video.h>

#include <cstdint>
#include <string>
#include <vector>

#include "mtstereo/parameters.hpp"

namespace mtstereo::test {

/// An 8-bit picture without padding.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;
};

/// A rectified pair: the whole of it at one disparity.
struct Pair {
  Picture left;
  Picture right;
};

/// A pair of smooth noise, `disparity` px apart. Another seed gives another picture.
Pair noise_pair(int width, int height, int disparity, unsigned seed);

/// Raw caps of a format: "video/x-raw,format=GRAY8,width=...", 30/1 fps unless told.
std::string raw_caps(const char* format, int width, int height, const char* framerate = "30/1");

/// How a frame lies in its buffer.
struct Layout {
  const char* format = "GRAY8";
  int padding = 0;          ///< bytes behind each row of the first plane
  int offset = 0;           ///< bytes ahead of the first row
  std::uint8_t poison = 0;  ///< what is in all bytes but the luma's, chroma planes too
};

/// A frame with this picture as its luma. With padding or offset it has a GstVideoMeta. A time in
/// ns, or GST_CLOCK_TIME_NONE.
GstBuffer* frame_buffer(const Picture& picture, GstClockTime pts, GstClockTime duration,
                        const Layout& layout = {});

/// What the library makes of a pair: 16-bit fixed point, row after row.
std::vector<std::uint16_t> library_map(const Pair& pair, const Parameters& parameters, int scale);

/// What the library says of how sure that is, row after row.
std::vector<std::uint8_t> library_confidence(const Pair& pair, const Parameters& parameters);

/// The confidence map that a disparity map carries, row after row; empty where it carries none.
std::vector<std::uint8_t> confidence_of(GstBuffer* disparity);

/// The pixels of a GRAY16_LE buffer with these caps, row after row.
std::vector<std::uint16_t> map_of(GstBuffer* buffer, int width, int height);

/// "" where both are the same, else where they differ first and how often.
std::string first_difference(const std::vector<std::uint16_t>& expected,
                             const std::vector<std::uint16_t>& actual, int width);

}  // namespace mtstereo::test
