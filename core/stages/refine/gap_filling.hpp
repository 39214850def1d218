// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"

namespace mtstereo {

/// Fills gaps: unknown pixels of a row or a column between two known ones that differ little and so
/// most likely belong to the same surface. The disparity is interpolated linearly and rounded to
/// the nearest 1/256 px (halves are rounded up). The confidence is half of the smaller one of the
/// two ends, at least 1. A gap at the image's border has only one end and is not filled.

/// Fills the gaps of at most `max_gap` pixels along the rows y0 .. y1 - 1 whose ends differ by at
/// most `tolerance` [1/256 px].
void fill_gaps_along_rows(int max_gap, std::int32_t tolerance, int y0, int y1,
                          Image<std::int32_t>& map, Image<std::uint8_t>& confidence);

/// The same along the columns x0 .. x1 - 1, in all rows. Blocks of columns may be processed
/// concurrently; they share no cache line if x0 is a multiple of 64. `scratch` is resized to
/// x1 - x0.
void fill_gaps_along_columns(int max_gap, std::int32_t tolerance, int x0, int x1,
                             Buffer<std::int32_t>& scratch, Image<std::int32_t>& map,
                             Image<std::uint8_t>& confidence);

}  // namespace mtstereo
