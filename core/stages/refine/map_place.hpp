// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace mtstereo {

/// Where the matched views are in a map, which may have twice their size and be shifted against
/// them: pixel x, y of the map is pixel (x - column) / scale, y / scale of the matched views, and
/// its disparity is `scale` times theirs plus `added`.
struct MapPlace {
  int scale = 1;
  int column = 0;  ///< of the map where the matched views begin, may be negative [px]
  int added = 0;   ///< to the disparities [px]

  /// What is added to the disparities of the map to get those of the views [px].
  int disparity_offset() const { return column - added; }
};

}  // namespace mtstereo
