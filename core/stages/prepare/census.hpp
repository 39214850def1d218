// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/image.hpp"

namespace mtstereo {

/// The step census, the input of all census costs: which pixels of the 5x5 window are darker than
/// its center. The result is invariant to a camera's gain and offset and to any other monotonic
/// change of the gray values.

/// Bits of a pixel's census transform: the window without its center.
inline constexpr int kCensusBits = 24;

/// Bytes of a pixel's census transform.
inline constexpr int kCensusBytes = kCensusBits / 8;

/// The census transform of a view: per pixel a word whose bits 0 .. 23 are those of the window's
/// pixels, row by row from the top left.
struct CensusImage {
  Image<std::uint32_t> bits;

  void resize(int width, int height) { bits.resize(width, height); }
};

/// Scratch memory of one thread: the rows of a band with their borders.
struct CensusScratch {
  Image<std::uint8_t> padded;

  /// For bands of up to `rows` rows of views of up to this width.
  void resize(int width, int rows);
};

/// Writes the rows y0 .. y1 - 1. The border's pixels are repeated outside of the image. `scratch`
/// is resized if it is too small for the band.
void census_rows(GrayView image, int y0, int y1, CensusScratch& scratch, CensusImage& census);

/// Whether element x of a row is column x of the view, or the x-th column from the right end. In a
/// mirrored right view a larger disparity is further to the right.
enum class RowOrder { kForward, kMirrored };

/// Splits a row of `width` census words into byte planes: bits 0 .. 7 into the first plane and so
/// on. Appends `beyond` elements to each plane that repeat the last one; in a mirrored right view
/// they are the columns left of the image.
void split_census_row(const std::uint32_t* bits, int width, RowOrder order, int beyond,
                      std::uint8_t* const (&planes)[kCensusBytes]);

}  // namespace mtstereo
