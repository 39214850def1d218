// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdlib>

#include "support/plane.hpp"

namespace mtstereo::reference {

/// Removes each disparity that more pixels of the window contradict than support: a pixel dx
/// columns away supports it if the two differ by at most |dx| px. The window has 2 radius columns
/// and rows; its pixel number `radius` is the one that is tested. Disparities are compared in 1/32
/// px.
inline DisparityPlane remove_outliers(const DisparityPlane& map, int radius) {
  if (radius == 0) return map;
  const auto vote = [](int disparity) { return (disparity + 4) / 8; };
  DisparityPlane kept = map;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      if (map(x, y) == 0) continue;
      int support = 0;
      int contradict = 0;
      for (int v = std::max(y - radius, 0); v < std::min(y + radius, map.height); ++v) {
        for (int u = std::max(x - radius, 0); u < std::min(x + radius, map.width); ++u) {
          if (map(u, v) == 0) continue;
          const int difference = std::abs(vote(map(u, v)) - vote(map(x, y)));
          ++(difference <= 32 * std::abs(u - x) ? support : contradict);
        }
      }
      if (contradict > support) kept(x, y) = 0;
    }
  }
  return kept;
}

}  // namespace mtstereo::reference
