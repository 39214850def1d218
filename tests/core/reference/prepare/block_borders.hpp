// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "support/plane.hpp"

namespace mtstereo::reference {

/// How clearly a view shows blocks of `side` px, from lists of what counts:
/// BlockBorders::visibility().
inline double border_visibility(const GrayPlane& view, int side) {
  std::vector<double> steps(side, 0.0);
  double count = 0;
  const auto change = [&](int x, int y) {  // between the pixels x - 1 and x
    return std::abs(view(x, y) - view(x - 1, y));
  };
  for (int y = 0; y < view.height; y += 4) {
    const int columns = std::max(view.width - 3, 0) / side * side;
    for (int x = 2; x < 2 + columns; ++x) {
      const double mean = (change(x - 1, y) + change(x + 1, y)) / 2.0;
      steps[x % side] += std::clamp(change(x, y) - mean, 0.0, 4.0);
    }
    count += static_cast<double>(columns) / side;
  }
  if (count == 0) return 0;
  double all = 0;
  for (const double sum : steps) all += sum;
  const double borders = *std::max_element(steps.begin(), steps.end());
  const double others = (all - borders) / (side - 1);
  return borders / std::max(others, 0.5) - 6 / std::sqrt(count);
}

}  // namespace mtstereo::reference
