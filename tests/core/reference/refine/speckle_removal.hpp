// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdlib>
#include <utility>
#include <vector>

#include "support/plane.hpp"

namespace mtstereo::reference {

using test::DisparityPlane;
using test::GrayPlane;

/// Finds the connected component of a known pixel by flood fill over neighbors whose disparities
/// differ by at most `tolerance`, and marks it as seen.
inline std::vector<std::pair<int, int>> flood(const DisparityPlane& map, int tolerance,
                                              std::pair<int, int> start, GrayPlane& seen) {
  std::vector<std::pair<int, int>> component = {start};
  seen(start.first, start.second) = 1;
  for (std::size_t i = 0; i < component.size(); ++i) {
    const auto [x, y] = component[i];
    for (const auto& [u, v] : {std::pair{x - 1, y}, {x + 1, y}, {x, y - 1}, {x, y + 1}}) {
      if (u < 0 || u >= map.width || v < 0 || v >= map.height) continue;
      if (map(u, v) == 0 || seen(u, v) != 0) continue;
      if (std::abs(map(u, v) - map(x, y)) > tolerance) continue;
      seen(u, v) = 1;
      component.emplace_back(u, v);
    }
  }
  return component;
}

/// Removes the connected components of fewer than `size` pixels.
inline DisparityPlane remove_speckles(const DisparityPlane& map, int tolerance, int size) {
  DisparityPlane kept = map;
  GrayPlane seen(map.width, map.height);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      if (map(x, y) == 0 || seen(x, y) != 0) continue;
      const auto component = flood(map, tolerance, {x, y}, seen);
      if (static_cast<long>(component.size()) >= size) continue;
      for (const auto& [u, v] : component) kept(u, v) = 0;
    }
  }
  return kept;
}

}  // namespace mtstereo::reference
