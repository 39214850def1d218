// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"

namespace mtstereo {

/// Enlarges the disparity map of halved views (halving.hpp) to the size of the views. All functions
/// work on bands of rows.

/// Writes the rows y0 .. y1 - 1 of `map`; the sides of `half` are half_of() the sides of `map`.
/// Each pixel is interpolated bilinearly between its half pixel and the three nearest other ones.
/// Of these, the ones without a disparity or with one that differs from the half pixel's by more
/// than 1 (in half pixels) are replaced by the half pixel's: they belong to another surface.
/// Without a disparity of the half pixel there is none.
///
/// Where the disparity of column X of `half` is at most X, that of `map` is at most the column,
/// too. All of `map` are below max_disparity [px].
void enlarge_rows(const Image<std::int32_t>& half, int max_disparity, int y0, int y1,
                  Image<std::int32_t>& map);

/// Writes the rows y0 .. y1 - 1 of `confidence`: each pixel copies its half pixel.
void enlarge_confidence(const Image<std::uint8_t>& half, int y0, int y1,
                        Image<std::uint8_t>& confidence);

}  // namespace mtstereo
