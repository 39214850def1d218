// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"

namespace mtstereo {

/// Fills gaps: unknown pixels of a row or a column between two known ones that differ little and so
/// most likely belong to the same surface. The disparity is interpolated linearly and rounded to
/// the nearest 1/256 px (halves are rounded up). The confidence is half of the smaller one of the
/// two ends, within 1 .. most_confidence. A gap at the image's border has only one end and is not
/// filled.

/// Which gaps are filled.
struct GapFilling {
  int max_gap;             ///< at most this many pixels
  std::int32_t tolerance;  ///< whose ends differ by at most this [1/256 px]
  std::uint8_t most_confidence = 255;
};

/// Fills the gaps along the rows y0 .. y1 - 1.
void fill_gaps_along_rows(const GapFilling& gaps, int y0, int y1, Image<std::int32_t>& map,
                          Image<std::uint8_t>& confidence);

/// Pixels of a row whose gaps are found together.
inline constexpr int kGapColumns = 64;

/// The same along the columns x0 .. x1 - 1, in all rows. Blocks that begin at multiples of
/// kGapColumns may be processed concurrently: they share no vector and no cache line.
void fill_gaps_along_columns(const GapFilling& gaps, int x0, int x1, Image<std::int32_t>& map,
                             Image<std::uint8_t>& confidence);

}  // namespace mtstereo
