// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <map>

#include "support/plane.hpp"
#include "support/random.hpp"

namespace mtstereo::test {

/// A map of half the size: areas with disparities near a few values, single outliers, and gaps.
inline DisparityPlane random_half_map(int width, int height, int disparities, int known,
                                      Random& random) {
  DisparityPlane map((width + 1) / 2, (height + 1) / 2);
  const int most = 256 * std::max((disparities + 1) / 2, 1) - 1;
  const int tile = random.between(4, 30);
  std::map<int, int> areas;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      if (random.below(100) >= known) continue;
      const int area = y / tile * 1000 + x / tile;
      if (!areas.contains(area)) areas[area] = random.between(1, most);
      const int d =
          random.below(20) == 0 ? random.between(1, most) : areas[area] + random.between(-300, 300);
      map(x, y) = std::clamp(d, 1, most);
    }
  }
  return map;
}

}  // namespace mtstereo::test
