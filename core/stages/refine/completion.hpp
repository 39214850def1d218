// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"

namespace mtstereo {

/// Gives every pixel a disparity: a gap in a row gets the smaller disparity of its two sides, since
/// what one camera does not see is part of the background. The rims of the row continue its first
/// and its last disparity. Mode semi-dense drops the inferred ones again, after the rating.
///
/// Call complete_rows() for all bands of rows, then complete_empty_rows() once.

/// The confidence of an inferred disparity decreases by 1 in as many pixels from the nearest
/// matched one of the row.
inline constexpr int kInferredStep = 4;

/// Completes the rows y0 .. y1 - 1 that have a disparity; the others stay empty. Confidence: from
/// kMostInferred down to 1 for inferred disparities, and above kMostInferred for matched ones.
void complete_rows(int y0, int y1, Image<std::int32_t>& map, Image<std::uint8_t>& confidence);

/// Completes the empty rows from the nearest row that is not empty, the upper one of two, at the
/// lowest confidence. A map without any disparity becomes infinitely far: 1 / kDisparityOne px.
void complete_empty_rows(Image<std::int32_t>& map, Image<std::uint8_t>& confidence);

}  // namespace mtstereo
