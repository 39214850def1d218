// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/image.hpp"

namespace mtstereo {

/// Undoes the shift of the views (view_shift.hpp) in the map: `out` and `out_confidence` have the
/// size of the input views.

/// Writes the rows y0 .. y1 - 1. The smallest disparity is added to the disparities if it is
/// positive; if it is negative, disparities stay relative to it, and those whose partner is outside
/// of the right view are removed. Where a disparity is removed, and where the shifted views have no
/// pixel, the map is kNoDisparity and the confidence 0.
void shift_map(const Image<std::int32_t>& map, const Image<std::uint8_t>& confidence,
               int min_disparity, int y0, int y1, Image<std::int32_t>& out,
               Image<std::uint8_t>& out_confidence);

}  // namespace mtstereo
