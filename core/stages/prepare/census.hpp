// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/image.hpp"

namespace mtstereo {

/// The step census, the input of all census costs: which pixels around a pixel are darker, in one
/// or two scales. One scale compares all pixels of the 5x5 window in the view itself. Two scales
/// compare its neighbors at 1 and 2 px, which locate edges, and those at 4 px in the smoothed view,
/// whose order of gray values blur, noise and compression seldom change.
///
/// The result does not depend on the brightness of the view. The bits of the view itself are
/// invariant to any monotonic change of the gray values, those of the smoothed view to gain, up to
/// rounding, and almost to others.

/// Bytes of a pixel's census transform.
inline constexpr int kCensusBytes = 3;

/// Bits of a pixel's census transform: one for each neighbor.
inline constexpr int kCensusBits = 8 * kCensusBytes;

/// Width of the binomial filter that smooths the view, weights 1 4 6 4 1 in both directions [px].
inline constexpr int kCensusSmoothing = 5;

/// The census transform of a view: per pixel a word. The bytes, the lowest first, belong to the
/// neighbors at 1 px in each of the eight directions, to those at 2 px, and to the remaining pixels
/// of the window (one scale) or to those at 4 px in the smoothed view (two scales). The highest
/// byte is 0. The bits of a byte belong to its neighbors row by row from the top left.
struct CensusImage {
  Image<std::uint32_t> bits;

  void resize(int width, int height, ReusedMemory* reused = nullptr) {
    bits.resize(width, height, reused);
  }
};

/// Scratch memory of one thread: the rows of a band with their borders, as gray values - 128.
struct CensusScratch {
  Image<std::int8_t> view;
  Image<std::int8_t> smoothed;  ///< for two scales
  Buffer<std::int16_t> sums;    ///< of the columns of a row's filter

  /// For bands that span up to `rows` rows of views of up to this width.
  void resize(int width, int rows);
};

/// Writes the rows y0 .. y1 - 1 in 1 or 2 scales: the transforms of every `row_step`-th row of the
/// image, 1, 2 or 4. The border's pixels are repeated outside of the image. `scratch` is resized if
/// it is too small for the band.
void census_rows(GrayView image, int scales, int row_step, int y0, int y1, CensusScratch& scratch,
                 CensusImage& census);

/// Splits a row of `width` census words into byte planes, bits 0 .. 7 into the first one and so on,
/// and mirrors it: in a mirrored right view a larger disparity is further to the right. Appends
/// `beyond` elements to each plane that repeat the last one, as columns left of the image.
void mirror_census_row(const std::uint32_t* bits, int width, int beyond,
                       std::uint8_t* const (&planes)[kCensusBytes]);

}  // namespace mtstereo
