// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "matcher/fine_detail.hpp"
#include "reference/refine/gap_filling.hpp"

namespace mtstereo::reference {

/// The two filters and the choice of the points, pixel by pixel.
inline FineDetail measure_detail(const GrayPlane& left, const GrayPlane& right,
                                 const ConfidentMap& in, int offset) {
  FineDetail sums;
  const int columns = std::min(left.width, right.width);
  for (int y = 0; y < left.height; y += kDetailRows) {
    for (int x = kDetailReach; x + kDetailReach < left.width; ++x) {
      const double disparity = in.map(x, y) / double{kDisparityOne};
      const int partner = x - static_cast<int>(std::lround(disparity)) - offset;
      if (in.map(x, y) == kNoDisparity || in.confidence(x, y) <= kMostInferred) continue;
      if (std::abs(disparity - std::lround(disparity)) > 0.125) continue;
      if (partner < kDetailReach || partner + kDetailReach >= columns) continue;
      const auto band = [&](const GrayPlane& view, int column, int step) -> std::int64_t {
        return view(column + 3 * step, y) - 9 * view(column + step, y) + 16 * view(column, y) -
               9 * view(column - step, y) + view(column - 3 * step, y);
      };
      sums.fine += band(left, x, 1) * band(right, partner, 1);
      sums.coarse += band(left, x, 2) * band(right, partner, 2);
      ++sums.points;
    }
  }
  return sums;
}

}  // namespace mtstereo::reference
