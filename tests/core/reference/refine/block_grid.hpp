// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <cmath>

#include "reference/refine/gap_filling.hpp"

namespace mtstereo::reference {

/// Whether the map of a compressed view matches its blocks of `side` px, from lists of what counts:
/// the level of BlockGrid.
inline int grid_level(double visibility, const ConfidentMap& in, int side) {
  double whole = 0, blocks = 0;
  for (int y = 0; y < in.map.height; y += 4) {
    for (int x = 0; x < in.map.width; ++x) {
      const double disparity = in.map(x, y) / 256.0;
      if (in.map(x, y) == 0 || in.confidence(x, y) < 16 || 2 * disparity < side) continue;
      whole += std::abs(disparity - std::round(disparity)) <= 0.125;
      blocks += std::abs(disparity - side * std::round(disparity / side)) <= 0.125;
    }
  }
  if (whole < 250 || visibility < 1.05) return 0;
  const double excess = blocks / std::max((whole - blocks) / (side - 1), 1.0);
  return (excess >= 1.2) + (excess >= 1.6) + (excess >= 2.3) + (excess >= 3.3);
}

/// The bin of the clue for a disparity [px].
inline int grid_bin(int level, int side, double disparity) {
  if (level == 0) return 0;
  const double distance = std::abs(disparity - side * std::round(disparity / side));
  int far = 4;
  if (2 * disparity >= side) {
    far = (distance >= 26 / 256.0) + (distance >= 0.25) + (distance >= 0.5) + (distance >= 1);
  }
  return 1 + 5 * (level - 1) + far;
}

}  // namespace mtstereo::reference
