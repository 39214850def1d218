// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"

namespace mtstereo {

/// Smooths the disparities of each surface, first along the rows, then along the columns: costs of
/// whole disparities draw them towards whole pixels, and noise is on all of them.
///
/// A pixel takes the mean of itself and of those pairs of pixels that lie opposite to each other,
/// equally far on both sides, and are both within 1 px of it: so a slanted surface stays where it
/// is, and the rim of one too, which has neighbors on one side only. A disparity stays possible at
/// its column. With a radius of 0 nothing changes.
///
/// smooth_along_rows() on bands of rows, then, when all are done, smooth_along_columns() on bands.

/// Scratch memory of one thread.
struct SmoothingScratch {
  Buffer<std::int32_t> line;          ///< a row with zeros on both sides
  Buffer<const std::int32_t*> lines;  ///< where the neighbors of a row's pixels begin

  /// The only one that allocates, for maps of this width and this radius or a smaller one.
  void resize(int width, int radius);
};

/// Writes the rows y0 .. y1 - 1 of `smoothed`, an image as large as the map.
void smooth_along_rows(const Image<std::int32_t>& map, int radius, int y0, int y1,
                       SmoothingScratch& scratch, Image<std::int32_t>& smoothed);

/// Writes the rows y0 .. y1 - 1 of the map; reads `radius` rows more of `smoothed` on both sides.
void smooth_along_columns(const Image<std::int32_t>& smoothed, int radius, int y0, int y1,
                          SmoothingScratch& scratch, Image<std::int32_t>& map);

}  // namespace mtstereo
