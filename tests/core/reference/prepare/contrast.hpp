// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <vector>

#include "support/plane.hpp"

namespace mtstereo::reference {

/// The range of the middle nine tenths of the gray values of every fourth row.
inline int gray_range(const GrayPlane& view) {
  std::vector<int> grays;
  for (int y = 0; y < view.height; y += 4) {
    for (int x = 0; x < view.width; ++x) grays.push_back(view(x, y));
  }
  std::sort(grays.begin(), grays.end());
  const std::size_t rest = grays.size() / 20;
  return grays[grays.size() - 1 - rest] - grays[rest];
}

}  // namespace mtstereo::reference
