// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "support/plane.hpp"

namespace mtstereo::reference {

using test::DisparityPlane;
using test::GrayPlane;

/// True where `matches` holds for a pixel of the window of 2 radius + 1 columns and rows.
template <typename Matches>
bool any_in_window(int x, int y, int radius, Matches&& matches) {
  for (int v = y - radius; v <= y + radius; ++v) {
    for (int u = x - radius; u <= x + radius; ++u) {
      if (matches(u, v)) return true;
    }
  }
  return false;
}

/// Closes what is known by 3x3 and removes each disparity with an unknown pixel in its window, in a
/// plane that is known all around the map.
inline DisparityPlane trim_rim(const DisparityPlane& map, int rim) {
  const auto outside = [&](int x, int y) {
    return x < 0 || x >= map.width || y < 0 || y >= map.height;
  };
  GrayPlane dilated(map.width, map.height);
  GrayPlane closed(map.width, map.height);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      dilated(x, y) =
          any_in_window(x, y, 1, [&](int u, int v) { return outside(u, v) || map(u, v) != 0; });
    }
  }
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      closed(x, y) =
          !any_in_window(x, y, 1, [&](int u, int v) { return !outside(u, v) && !dilated(u, v); });
    }
  }
  DisparityPlane kept = map;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const auto unknown = [&](int u, int v) { return !outside(u, v) && !closed(u, v); };
      if (any_in_window(x, y, rim, unknown)) kept(x, y) = 0;
    }
  }
  return kept;
}

}  // namespace mtstereo::reference
