// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdlib>

#include "support/plane.hpp"

namespace mtstereo::reference {

/// Bilinear interpolation between the centers of half-resolution pixels, which leaves out pixels of
/// another surface than the nearest one.
inline DisparityPlane enlarge(const DisparityPlane& half, int width, int height,
                              int max_disparity) {
  DisparityPlane map(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int nearest = half(x / 2, y / 2);
      if (nearest == 0) continue;
      double sum = 0;
      for (const bool beside : {false, true}) {
        for (const bool next : {false, true}) {
          const int at_x = beside ? (x % 2 == 0 ? x / 2 - 1 : x / 2 + 1) : x / 2;
          const int at_y = next ? (y % 2 == 0 ? y / 2 - 1 : y / 2 + 1) : y / 2;
          const int there = half.clamped(at_x, at_y);
          const bool together = there != 0 && std::abs(there - nearest) <= 256;
          const double weight = (beside ? 0.25 : 0.75) * (next ? 0.25 : 0.75);
          sum += weight * (together ? there : nearest);
        }
      }
      const int disparity = static_cast<int>(2 * sum + 0.5);
      const int most = nearest > 128 * x ? disparity : 256 * x;  // it may be beyond column 0
      map(x, y) = std::min({disparity, most, 256 * max_disparity - 1});
    }
  }
  return map;
}

/// Each pixel has the confidence of its half-resolution pixel.
inline GrayPlane enlarge_confidence(const GrayPlane& half, int width, int height) {
  GrayPlane confidence(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) confidence(x, y) = half(x / 2, y / 2);
  }
  return confidence;
}

}  // namespace mtstereo::reference
