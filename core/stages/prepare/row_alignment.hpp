// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/alignment.hpp"
#include "mtstereo/image.hpp"

namespace mtstereo {

/// Undoes the row displacement of the right view: resamples it by a RowField.

/// From which size on a roll also moves the rows sideways [tangent of the angle], and a stretch the
/// columns [fraction]. Below, the slope of the rows is more likely to have another cause.
inline constexpr double kSmallestRoll = 0.0017453;
inline constexpr double kSmallestStretch = 0.003;

/// The displacement of a row of the right view, in px, at column x: base + slope x, and sideways
/// shift + zoom x. The rows are displaced by a RowField; sideways it is zero unless the field has a
/// large roll or stretch.
struct RowDisplacement {
  double base = 0;
  double slope = 0;
  double shift = 0;
  double zoom = 0;

  bool moves_sideways() const { return shift != 0 || zoom != 0; }
};

RowDisplacement displacement_of_row(const RowField& field, int y, int width, int height);

/// Number of adjacent pixels of a row that are displaced alike [px].
inline constexpr int kAlignmentBlock = 16;

/// Largest displacement sideways [px]; larger ones are limited to it.
inline constexpr int kLargestSidewaysShift = 128;

/// Scratch memory of one thread: a row whose pixels are in the right row, but not yet moved
/// sideways, with a border.
struct AlignmentScratch {
  Buffer<std::uint8_t> row;

  void resize(int width);
};

/// Writes the rows y0 .. y1 - 1 of `out`, which has the size of the view: out(x, y) is the view at
/// the row y plus the field's displacement at (x, y), interpolated by cubic polynomials
/// (Catmull-Rom) in steps of 1/64 px. Blocks of kAlignmentBlock pixels, counted from the left
/// border, have the displacement of their center. Pixels of the border are repeated. `scratch` is
/// resized if it is too small.
void align_rows(GrayView view, const RowField& field, int y0, int y1, AlignmentScratch& scratch,
                Image<std::uint8_t>& out);

}  // namespace mtstereo
