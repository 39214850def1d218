// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <cstdlib>

#include "support/plane.hpp"

namespace mtstereo::reference {

/// The support of a disparity by the pixels within 4 px of it.
struct Support {
  long pixels = 0;  ///< pixels of the window inside the image
  long count = 0;   ///< of these, the ones with a supporting disparity
  long ratios = 0;  ///< sum of their peak ratios

  /// c * c * r, 0 .. 1.
  double share() const {
    const double c = static_cast<double>(count) / static_cast<double>(pixels);
    return c * c * static_cast<double>(ratios) / (255.0 * static_cast<double>(pixels));
  }
  /// The same in whole 1/4096.
  long share_steps() const {
    return count * count * ratios * 4096 / (255 * pixels * pixels * pixels);
  }
};

/// A disparity n px away (the larger of the distances in columns and rows) supports if it differs
/// by at most (32 + 13 n) / 32 px; disparities are compared in 1/32 px. Pixels count in every
/// `step`-th row and column.
inline Support support_of(const DisparityPlane& map, const GrayPlane& ratio, int step, int x,
                          int y) {
  const auto steps = [](int disparity) { return (disparity + 4) / 8; };
  Support support;
  for (int v = y - 4; v <= y + 4; v += step) {
    for (int u = x - 4; u <= x + 4; u += step) {
      if (u < 0 || u >= map.width || v < 0 || v >= map.height) continue;
      ++support.pixels;
      if (map(u, v) == 0) continue;
      const int away = std::max(std::abs(u - x), std::abs(v - y));
      if (std::abs(steps(map(u, v)) - steps(map(x, y))) > 32 + 13 * away) continue;
      ++support.count;
      support.ratios += ratio(u, v);
    }
  }
  return support;
}

/// 255 times the cube root of steps / 4096, rounded half up: the largest integer that exceeds it by
/// at most 1/2.
inline int cube_root(long steps) {
  long root = 255;
  while ((2 * root - 1) * (2 * root - 1) * (2 * root - 1) * 4096 > 8L * 255 * 255 * 255 * steps) {
    --root;
  }
  return static_cast<int>(root);
}

/// The cube root of each fraction of support, at least 1; 0 for an unknown disparity.
inline GrayPlane rate_support(const DisparityPlane& map, const GrayPlane& ratio, int step) {
  GrayPlane out(map.width, map.height);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      if (map(x, y) == 0) continue;
      const long steps = support_of(map, ratio, step, x, y).share_steps();
      out(x, y) = static_cast<std::uint8_t>(std::max(cube_root(steps), 1));
    }
  }
  return out;
}

/// The confidence times weight / 255, rounded, but at least 1 where it was.
inline GrayPlane weighed(const GrayPlane& confidence, const GrayPlane& weight) {
  GrayPlane out = confidence;
  for (std::size_t i = 0; i < out.pixels.size(); ++i) {
    if (out.pixels[i] == 0) continue;
    const double product = out.pixels[i] * weight.pixels[i] / 255.0;
    out.pixels[i] = static_cast<std::uint8_t>(std::max(std::floor(product + 0.5), 1.0));
  }
  return out;
}

}  // namespace mtstereo::reference
