// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <cstdlib>

#include "support/plane.hpp"

namespace mtstereo::reference {

using test::DisparityPlane;
using test::GrayPlane;

/// Gives the pixels whose disparity is negative in `found` their disparities back.
inline void restore_thin(const DisparityPlane& found, int least, DisparityPlane& map,
                         GrayPlane& confidence) {
  for (std::size_t i = 0; i < map.pixels.size(); ++i) {
    if (found.pixels[i] >= 0 || map.pixels[i] != 0) continue;
    map.pixels[i] = -found.pixels[i];
    confidence.pixels[i] = static_cast<std::uint8_t>(std::max(least, 1));
  }
}

/// Empties filled pixels around those that are more than 2 px farther than what was found there.
/// `before` is the map before the filling.
inline void check_foreground(const DisparityPlane& found, const DisparityPlane& before,
                             DisparityPlane& map, GrayPlane& confidence) {
  const DisparityPlane filled = map;
  const auto is_filled = [&](int x, int y) { return before(x, y) == 0 && filled(x, y) != 0; };
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      for (int j = std::max(y - 1, 0); j <= std::min(y + 1, map.height - 1); ++j) {
        for (int i = std::max(x - 1, 0); i <= std::min(x + 1, map.width - 1); ++i) {
          if (!is_filled(x, y) || !is_filled(i, j)) continue;
          if (std::abs(found(i, j)) - filled(i, j) <= 512) continue;
          map(x, y) = 0;
          confidence(x, y) = 0;
        }
      }
    }
  }
}

/// Draws thin structures into a complete map that may be larger and shifted, and with `guard`
/// empties what is more than 2 px farther than something else that was found there.
inline void draw_thin_structures(const DisparityPlane& found, int shift, int scale, int least,
                                 bool guard, DisparityPlane& map, GrayPlane& confidence) {
  for (int y = 0; y < map.height; ++y) {
    for (int x = std::max(shift, 0); x < map.width; ++x) {
      const int column = (x - shift) / scale;
      if (column >= found.width) continue;
      const int value = found(column, y / scale);
      const int there = std::abs(value) * scale + 256 * std::max(shift, 0);
      if (value < 0) {
        map(x, y) = there;
        confidence(x, y) = std::max(confidence(x, y), static_cast<std::uint8_t>(least));
      } else if (guard && value > 0 && there - map(x, y) > 512) {
        map(x, y) = 0;
        confidence(x, y) = 0;
      }
    }
  }
}

}  // namespace mtstereo::reference
