// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <vector>

#include "support/plane.hpp"

namespace mtstereo::reference {

/// The gray values of every fourth row, in ascending order.
inline std::vector<int> sorted_grays(const GrayPlane& view) {
  std::vector<int> grays;
  for (int y = 0; y < view.height; y += 4) {
    for (int x = 0; x < view.width; ++x) grays.push_back(view(x, y));
  }
  std::sort(grays.begin(), grays.end());
  return grays;
}

/// The range of the middle nine tenths of the gray values.
inline int gray_range(const GrayPlane& view) {
  const std::vector<int> grays = sorted_grays(view);
  const std::size_t rest = grays.size() / 20;
  return grays[grays.size() - 1 - rest] - grays[rest];
}

/// 2 below the brightest value that a thousandth of the pixels reach; 256 if less than a hundredth
/// are that bright.
inline int clipped_from(const GrayPlane& view) {
  const std::vector<int> grays = sorted_grays(view);
  const std::size_t reaching = (grays.size() + 999) / 1000;
  const int least = std::max(grays[grays.size() - reaching], 2) - 2;
  const auto clipped = grays.end() - std::lower_bound(grays.begin(), grays.end(), least);
  return static_cast<std::size_t>(clipped) * 100 < grays.size() ? 256 : least;
}

}  // namespace mtstereo::reference
