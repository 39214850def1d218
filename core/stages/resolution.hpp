// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/image.hpp"

namespace mtstereo {

/// What surrounds the method where the views are matched at half resolution: each view is halved,
/// and the map that comes out is enlarged. The half pixel (X, Y) stands for the pixels 2X, 2X + 1
/// of the rows 2Y, 2Y + 1. All functions work on bands of rows.

/// How many half pixels stand for a side of this many pixels.
constexpr int half_of(int side) { return (side + 1) / 2; }

/// Writes the rows y0 .. y1 - 1 of `half`, whose sides are the halves of the view's: the rounded
/// mean of 2x2 pixels. The last column or row of an odd side stands for itself.
void halve_rows(GrayView view, int y0, int y1, Image<std::uint8_t>& half);

/// Writes the rows y0 .. y1 - 1 of `map`, whose sides have the sides of `half` as their halves. A
/// pixel takes the disparity of its half pixel, and linearly those of the three nearest ones that
/// are within a half pixel's disparity of it: the others belong to something else. Nothing where
/// the half pixel has nothing.
///
/// In `half`, as in all maps, the disparity of column X is at most X; in `map` it is at most the
/// column too, and below max_disparity [px].
void enlarge_rows(const Image<std::int32_t>& half, int max_disparity, int y0, int y1,
                  Image<std::int32_t>& map);

/// Writes the rows y0 .. y1 - 1 of `confidence`: each pixel has that of its half pixel.
void enlarge_confidence(const Image<std::uint8_t>& half, int y0, int y1,
                        Image<std::uint8_t>& confidence);

}  // namespace mtstereo
