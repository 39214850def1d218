// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "support/plane.hpp"

namespace mtstereo::reference {

/// A disparity map and the confidence of its pixels.
struct ConfidentMap {
  DisparityPlane map;
  GrayPlane confidence;

  friend bool operator==(const ConfidentMap&, const ConfidentMap&) = default;
};

/// Number of steps (dx, dy) from (x, y) to the first known pixel; 0 if there is none.
inline int steps_to_known(const DisparityPlane& map, int x, int y, int dx, int dy) {
  for (int steps = 1;; ++steps) {
    const int u = x + steps * dx;
    const int v = y + steps * dy;
    if (u < 0 || u >= map.width || v < 0 || v >= map.height) return 0;
    if (map(u, v) != 0) return steps;
  }
}

/// Searches from each unknown pixel in both directions of (dx, dy): one of them is 0, the other 1.
inline ConfidentMap fill_gaps(const ConfidentMap& in, int max_gap, int tolerance, int dx, int dy,
                              int most_confidence = 255) {
  ConfidentMap out = in;
  for (int y = 0; y < in.map.height; ++y) {
    for (int x = 0; x < in.map.width; ++x) {
      if (in.map(x, y) != 0) continue;
      const long back = steps_to_known(in.map, x, y, -dx, -dy);
      const long ahead = steps_to_known(in.map, x, y, dx, dy);
      if (back == 0 || ahead == 0 || back + ahead - 1 > max_gap) continue;
      const int x0 = x - static_cast<int>(back) * dx;
      const int y0 = y - static_cast<int>(back) * dy;
      const int x1 = x + static_cast<int>(ahead) * dx;
      const int y1 = y + static_cast<int>(ahead) * dy;
      const long first = in.map(x0, y0);
      const long second = in.map(x1, y1);
      if (std::labs(first - second) > tolerance) continue;
      const long steps = back + ahead;
      out.map(x, y) =
          static_cast<std::int32_t>((2 * (first * ahead + second * back) + steps) / (2 * steps));
      const int weaker = std::min(in.confidence(x0, y0), in.confidence(x1, y1));
      out.confidence(x, y) =
          static_cast<std::uint8_t>(std::min(weaker < 2 ? 1 : weaker / 2, most_confidence));
    }
  }
  return out;
}

}  // namespace mtstereo::reference
