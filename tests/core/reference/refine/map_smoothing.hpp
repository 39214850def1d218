// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdlib>

#include "support/plane.hpp"

namespace mtstereo::reference {

/// The mean of each pixel and of the pairs of pixels at equal distance on both sides along (dx,
/// dy), if both belong to the same surface.
inline DisparityPlane smooth_along(const DisparityPlane& map, int radius, int dx, int dy) {
  const auto at = [&](int x, int y) {
    return x >= 0 && x < map.width && y >= 0 && y < map.height ? map(x, y) : 0;
  };
  DisparityPlane smoothed(map.width, map.height);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const int own = map(x, y);
      if (own == 0) continue;
      const auto continues = [&](int d) { return d != 0 && std::abs(d - own) <= 256; };
      int rise = 0, count = 1;
      for (int i = 1; i <= radius; ++i) {
        const int one = at(x - i * dx, y - i * dy), other = at(x + i * dx, y + i * dy);
        if (!continues(one) || !continues(other)) continue;
        rise += one - own + other - own;
        count += 2;
      }
      smoothed(x, y) = own + rise / count;
    }
  }
  return smoothed;
}

inline DisparityPlane smooth(const DisparityPlane& map, int radius) {
  return smooth_along(smooth_along(map, radius, 1, 0), radius, 0, 1);
}

}  // namespace mtstereo::reference
