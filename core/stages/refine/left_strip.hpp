// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/image.hpp"

namespace mtstereo {

/// Corrects the strip at the left of a complete map that the right camera may not see. There a
/// surface cannot be matched at its own disparity d in the columns before d, so that the matching
/// finds something much farther there where the surface has little texture.

/// A disparity of the strip is doubted below this confidence, and a surface believed from it on.
inline constexpr int kBelievedStrip = 100;

/// In the first `strip` columns of the rows y0 .. y1 - 1 of a rated map: a doubted disparity of
/// less than half the next believed one to the right takes the smaller one of the disparities on
/// both sides of the pixels like it, as in completion.hpp. Its confidence becomes 1, the lowest.
void correct_left_strip(int strip, int y0, int y1, Image<std::int32_t>& map,
                        Image<std::uint8_t>& confidence);

}  // namespace mtstereo
