// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"

namespace mtstereo {

/// Fills gaps: unknown pixels between two known ones of a row or a column that differ little, which
/// so most likely belong to one surface. In between the disparity is linear, rounded to the nearest
/// 1/256 px (half of one up), and the confidence is half of the smaller of the two ends', at
/// least 1. A gap that reaches the image's border has one end only and stays.

/// Fills the gaps of at most `max_gap` pixels along the rows y0 .. y1 - 1 whose ends differ by at
/// most `tolerance` [1/256 px].
void fill_gaps_along_rows(int max_gap, std::int32_t tolerance, int y0, int y1,
                          Image<std::int32_t>& map, Image<std::uint8_t>& confidence);

/// The same along the columns x0 .. x1 - 1, all rows of them. Blocks of columns may run at once;
/// where x0 is a multiple of 64 they share no cache lines. `scratch` is resized to x1 - x0.
void fill_gaps_along_columns(int max_gap, std::int32_t tolerance, int x0, int x1,
                             Buffer<std::int32_t>& scratch, Image<std::int32_t>& map,
                             Image<std::uint8_t>& confidence);

}  // namespace mtstereo
