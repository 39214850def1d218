// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/image.hpp"

namespace mtstereo {

/// What the census cost is made of: which pixels of the 5x5 window are darker than its center. Gain
/// and offset of a camera, and any other monotonic change of the gray values, do not change it.

/// Bits of a pixel's census transform: the window without its center.
inline constexpr int kCensusBits = 24;

/// The census transform of a view, eight bits in each plane. Behind the last column of the view
/// come `beyond` more that repeat it: what a right pixel left of the image is taken for.
struct CensusImage {
  std::array<Image<std::uint8_t>, kCensusBits / 8> plane;
  int width = 0;  ///< of the view

  void resize(int view_width, int height, int beyond);
};

/// Whether column x of the result is column x of the view, or counts from the right end: then a
/// rising disparity runs to the right.
enum class CensusOrder { kForward, kMirrored };

/// Writes the rows y0 .. y1 - 1. Beyond the border the border's pixels are repeated. `scratch` is
/// resized to the band at the first use.
void census_rows(GrayView image, CensusOrder order, int y0, int y1, Image<std::uint8_t>& scratch,
                 CensusImage& census);

}  // namespace mtstereo
