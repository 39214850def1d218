// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdlib>

#include "reference/prepare/census.hpp"
#include "stages/pixels/row_walk.hpp"

namespace mtstereo::reference {

/// P2 at a change of the gray value by `change`; 0 disables the optimization.
inline int large_step(const SmoothnessOptions& options, int change) {
  if (options.large_step == 0) return 0;
  return std::min(std::max(options.large_step * options.edge / (options.edge + kEdgeParts * change),
                           options.small_step),
                  255);
}

/// The costs along the path from the left (direction 1) or from the right (-1).
inline RowCosts path_costs(const RowCosts& costs, const std::uint8_t* gray,
                           const SmoothnessOptions& options, int direction) {
  const int width = static_cast<int>(costs.size());
  const int disparities = static_cast<int>(costs[0].size());
  RowCosts path = costs;
  for (int i = 1; i < width; ++i) {
    const int x = direction > 0 ? i : width - 1 - i;
    const std::vector<int>& before = path[x - direction];
    int least = 255;
    for (const int cost : before) {
      if (cost != kOutside) least = std::min(least, cost);
    }
    // A step comes from a disparity in the windows of both pixels.
    const auto from = [&](int d) {
      const bool exists = d >= 0 && d < disparities && before[d] != kOutside;
      return exists && costs[x][d] != kOutside ? before[d] : 255;
    };
    const int jump = least + large_step(options, std::abs(gray[x] - gray[x - direction]));
    for (int d = 0; d < disparities; ++d) {
      if (costs[x][d] == kOutside) continue;
      const int adjacent = std::min(from(d - 1), from(d + 1)) + options.small_step;
      const int best = std::min({from(d), adjacent, jump});
      path[x][d] = std::min(costs[x][d] + best - least, 255);
    }
  }
  return path;
}

/// Twice the mean costs of both paths along the row, and of those along the column if there are
/// any; in the range of two paths.
inline RowCosts path_sums(const RowCosts& costs, const std::uint8_t* gray,
                          const SmoothnessOptions& options, PathSums kind,
                          const RowCosts& above = {}, const RowCosts& below = {}) {
  const auto mean = [](int a, int b) { return (a + b + 1) / 2; };
  const RowCosts from_left = path_costs(costs, gray, options, 1);
  const RowCosts from_right = path_costs(costs, gray, options, -1);
  RowCosts sums = costs;
  for (std::size_t x = 0; x < sums.size(); ++x) {
    for (std::size_t d = 0; d < sums[x].size(); ++d) {
      if (sums[x][d] == kOutside) continue;
      const int left = from_left[x][d], right = from_right[x][d];
      if (kind == PathSums::kTwo) {
        sums[x][d] = 2 * mean(left, right);
      } else {
        sums[x][d] = 2 * mean(mean(left, right), mean(above[x][d], below[x][d]));
      }
    }
  }
  return sums;
}

/// Twice the costs, which have the range of two paths.
inline RowCosts twice(RowCosts costs) {
  for (std::vector<int>& pixel : costs) {
    for (int& cost : pixel) cost = cost == kOutside ? kOutside : 2 * cost;
  }
  return costs;
}

}  // namespace mtstereo::reference
