// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"

namespace mtstereo {

/// Enlarges the disparity map of halved views (halving.hpp) to the views' size. All functions work
/// on bands of rows.

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
