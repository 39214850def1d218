// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/image.hpp"

namespace mtstereo {

/// Step 4, which all census costs are made of: which pixels of the 5x5 window are darker than its
/// center. Gain and offset of a camera, and any other monotonic change of the gray values, do not
/// change it.

/// Bits of a pixel's census transform: the window without its center.
inline constexpr int kCensusBits = 24;

/// Bytes of a pixel's census transform.
inline constexpr int kCensusBytes = kCensusBits / 8;

/// The census transform of a view: of each pixel the bits 0 .. 23 of a word, one for each neighbor,
/// row by row from the top left.
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

/// Writes the rows y0 .. y1 - 1. Beyond the border the border's pixels are repeated. `scratch` is
/// resized where it is too small.
void census_rows(GrayView image, int y0, int y1, CensusScratch& scratch, CensusImage& census);

/// Whether element x of a row is column x of the view, or counts from the right end: then a rising
/// disparity runs to the right.
enum class RowOrder { kForward, kMirrored };

/// Takes a row of `width` census words apart into rows of bytes: bits 0 .. 7 into the first plane
/// and so on. Behind each come `beyond` elements more that repeat the last one: in a mirrored right
/// view they stand for what is left of the image.
void split_census_row(const std::uint32_t* bits, int width, RowOrder order, int beyond,
                      std::uint8_t* const (&planes)[kCensusBytes]);

}  // namespace mtstereo
