// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"

namespace mtstereo {

/// Trims the rim of what is known: the pixels near the unknown, where windows have reached across
/// the edges of objects. Holes that a closing by 3x3 fills have no rim, and neither has the image's
/// border: what is beyond it counts as known.
///
/// mark_rim() on bands of rows, then, when all are done, trim_rim() on bands of rows. With a rim of
/// 0 px both do nothing.

/// Scratch memory of one thread.
struct RimScratch {
  Buffer<std::uint8_t> line;    ///< a row with what the window reaches beyond it
  Buffer<std::uint16_t> count;  ///< of each column the marks within the window's rows

  /// The only one that allocates, for maps of this width and this rim or a narrower one.
  void resize(int width, int rim);
};

/// Marks in the rows y0 .. y1 - 1 of `marks`, an image as large as the map, with 1 the pixels that
/// are, in their row, near enough to the unknown, with 0 all others. Reads the rows y0 - 1 .. y1 of
/// the map.
void mark_rim(const Image<std::int32_t>& map, int rim, int y0, int y1, RimScratch& scratch,
              Image<std::uint8_t>& marks);

/// Removes from the rows y0 .. y1 - 1 every disparity in whose window of 2 rim + 1 columns and rows
/// is a pixel that is unknown after the closing. Reads the marks of rim + 1 rows more on both
/// sides.
void trim_rim(const Image<std::uint8_t>& marks, int rim, int y0, int y1, RimScratch& scratch,
              Image<std::int32_t>& map);

}  // namespace mtstereo
