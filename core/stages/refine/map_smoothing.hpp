// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"

namespace mtstereo {

/// Smooths the disparities of each surface, first along the rows, then along the columns. This
/// reduces noise and the bias towards whole pixels that costs at whole disparities cause.
///
/// A pixel takes the mean of itself and of pairs of pixels at the same distance on both sides of
/// it. A pair counts only if the disparities of both differ from the pixel's by at most 1 px. So a
/// slanted surface does not move, nor does its border, which has neighbors on one side only. No
/// disparity exceeds its column afterwards. A radius of 0 changes nothing.
///
/// Call smooth_along_rows() for all bands of rows, then smooth_along_columns() for all bands.

/// Scratch memory of one thread.
struct SmoothingScratch {
  Buffer<std::int32_t> line;          ///< a row with zeros on both sides
  Buffer<const std::int32_t*> lines;  ///< the begins of the shifted rows or of the neighboring rows

  /// The only function that allocates. Sufficient for maps of this width and for radii up to this.
  void resize(int width, int radius);
};

/// Writes the rows y0 .. y1 - 1 of `smoothed`, which has the size of the map.
void smooth_along_rows(const Image<std::int32_t>& map, int radius, int y0, int y1,
                       SmoothingScratch& scratch, Image<std::int32_t>& smoothed);

/// Writes the rows y0 .. y1 - 1 of the map; reads `radius` further rows of `smoothed` on both
/// sides.
void smooth_along_columns(const Image<std::int32_t>& smoothed, int radius, int y0, int y1,
                          SmoothingScratch& scratch, Image<std::int32_t>& map);

}  // namespace mtstereo
