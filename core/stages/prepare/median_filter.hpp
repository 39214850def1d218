// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/image.hpp"

namespace mtstereo {

/// The median filter of the step preprocessing (paper, "Pre-processing").

/// Side of the median's window [px].
inline constexpr int kMedianSide = 5;

/// Scratch memory of one thread: the columns of the windows of one row, sorted.
struct MedianScratch {
  std::array<Buffer<std::uint8_t>, kMedianSide> sorted;

  void resize(int width);
};

/// Writes the rows y0 .. y1 - 1: the median of the 5x5 window around each pixel. The border's
/// pixels are repeated outside of the image. `scratch` is resized if it is too small.
void median_rows(GrayView image, int y0, int y1, MedianScratch& scratch,
                 Image<std::uint8_t>& median);

}  // namespace mtstereo
