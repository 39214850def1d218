// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "reference/refine/gap_filling.hpp"

namespace mtstereo::reference {

/// Whether the map of a compressed view matches its blocks of `side` px, from lists of what counts:
/// the level of BlockGrid.
inline int grid_level(const GrayPlane& left, const ConfidentMap& in, int side) {
  std::vector<double> steps(side, 0.0);
  double whole = 0, blocks = 0, count = 0;
  const auto change = [&](int x, int y) {  // between the pixels x - 1 and x
    return std::abs(left(x, y) - left(x - 1, y));
  };
  for (int y = 0; y < left.height; y += 4) {
    const int columns = std::max(left.width - 3, 0) / side * side;
    for (int x = 2; x < 2 + columns; ++x) {
      const double mean = (change(x - 1, y) + change(x + 1, y)) / 2.0;
      steps[x % side] += std::clamp(change(x, y) - mean, 0.0, 4.0);
    }
    count += static_cast<double>(columns) / side;
    for (int x = 0; x < left.width; ++x) {
      const double disparity = in.map(x, y) / 256.0;
      if (in.map(x, y) == 0 || in.confidence(x, y) < 16 || 2 * disparity < side) continue;
      whole += std::abs(disparity - std::round(disparity)) <= 0.125;
      blocks += std::abs(disparity - side * std::round(disparity / side)) <= 0.125;
    }
  }
  double all = 0;
  for (const double sum : steps) all += sum;
  const double borders = *std::max_element(steps.begin(), steps.end());
  if (whole < 250 || count == 0) return 0;
  if (borders < (1.05 + 6 / std::sqrt(count)) * (all - borders) / (side - 1)) return 0;
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
