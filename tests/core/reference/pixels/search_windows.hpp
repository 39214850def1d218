// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <map>
#include <vector>

#include "reference/prepare/census.hpp"
#include "stages/pixels/search_windows.hpp"
#include "support/plane.hpp"

namespace mtstereo::reference {

/// The windows of all tiles; without tiles, all disparities.
struct Windows {
  int columns = 0;
  std::vector<CostWindow> tiles = {};

  bool contain(int x, int y, int d) const {
    if (tiles.empty()) return true;
    const CostWindow& window = tiles[y / 16 * columns + x / 16];
    return window.begin <= d && d < window.end;
  }
};

/// Marks the costs outside of the windows of row y.
inline void leave_out(const Windows& windows, int y, RowCosts& costs) {
  for (std::size_t x = 0; x < costs.size(); ++x) {
    for (std::size_t d = 0; d < costs[x].size(); ++d) {
      if (!windows.contain(static_cast<int>(x), y, static_cast<int>(d))) costs[x][d] = kOutside;
    }
  }
}

/// The votes of the pixels x0 .. x1 - 1, y0 .. y1 - 1 at half the resolution, for bins of 16.
inline std::map<int, int> votes_in(const test::DisparityPlane& half, int x0, int x1, int y0,
                                   int y1) {
  std::map<int, int> votes;
  for (int y = std::max(y0, 0); y < std::min(y1, half.height); ++y) {
    for (int x = std::max(x0, 0); x < std::min(x1, half.width); ++x) {
      if (half(x, y) == 0) continue;
      const int disparity = (2 * half(x, y) + 128) / 256;
      std::map<int, int> own;
      for (int d = std::max(disparity - 2, 0); d <= disparity + 2; ++d) own[d / 16] = 1;
      for (const auto& [bin, one] : own) votes[bin] += one;
    }
  }
  return votes;
}

/// The windows of a view of this size and so many lanes, by both maps at half the resolution.
inline Windows choose_windows(const test::DisparityPlane& by_path,
                              const test::DisparityPlane& by_cost, int width, int height,
                              int lanes) {
  Windows windows;
  windows.columns = (width + 15) / 16;
  const int rows = (height + 15) / 16;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < windows.columns; ++column) {
      const int x0 = 8 * (column - 1), x1 = x0 + 24, y0 = 8 * (row - 1), y1 = y0 + 24;
      int known = 0;
      for (int y = std::max(y0, 0); y < std::min(y1, by_path.height); ++y) {
        for (int x = std::max(x0, 0); x < std::min(x1, by_path.width); ++x) {
          known += by_path(x, y) != 0;
        }
      }
      const int tiles = (std::min(column + 2, windows.columns) - std::max(column - 1, 0)) *
                        (std::min(row + 2, rows) - std::max(row - 1, 0));
      int first = lanes, last = -1;
      const auto elect = [&](const std::map<int, int>& votes, int least) {
        for (const auto& [bin, count] : votes) {
          if (count < least || 16 * bin >= lanes) continue;
          first = std::min(first, 16 * bin);
          last = std::max(last, 16 * bin + 16);
        }
      };
      elect(votes_in(by_path, x0, x1, y0, y1), 12);
      elect(votes_in(by_cost, x0, x1, y0, y1), 3);
      if (10 * known < 64 * tiles || last < 0) {
        first = 0;
        last = lanes;
      }
      // Whole vectors of 32.
      if ((last - first) % 32 != 0) (first > 0 ? first -= 16 : last += 16);
      windows.tiles.push_back(
          {static_cast<std::uint16_t>(first), static_cast<std::uint16_t>(last)});
    }
  }
  return windows;
}

}  // namespace mtstereo::reference
