// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/image.hpp"

namespace mtstereo {

/// Halves the views if they are matched at half resolution. The half pixel (X, Y) covers the pixels
/// 2X, 2X + 1 of the rows 2Y, 2Y + 1. The counterpart for maps is enlarging.hpp.

/// Number of half pixels that cover a side of `side` pixels.
constexpr int half_of(int side) { return (side + 1) / 2; }

/// Writes the rows y0 .. y1 - 1 of `half`, whose sides are half_of() the view's: the rounded
/// mean of 2x2 pixels. The last column or row of an odd side is repeated.
void halve_rows(GrayView view, int y0, int y1, Image<std::uint8_t>& half);

}  // namespace mtstereo
