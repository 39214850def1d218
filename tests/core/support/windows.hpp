// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "base/buffer.hpp"
#include "reference/pixels/search_windows.hpp"
#include "stages/pixels/census_cost.hpp"
#include "stages/pixels/search_windows.hpp"
#include "support/random.hpp"

namespace mtstereo::test {

/// Windows of all kinds for views of this size: every few tiles a vote for a few disparities.
inline SearchWindows random_windows(int width, int height, int lanes, Random& random) {
  WindowVotes votes;
  votes.resize(width, height, lanes);
  clear_votes(0, (height + 1) / 2, votes);
  for (int tile = 0; tile < votes.columns * votes.rows; ++tile) {
    votes.known[tile] = 64;
    if (random.below(4) == 0) votes.by_path[tile * votes.bins + random.below(votes.bins)] = 64;
  }
  SearchWindows windows;
  windows.resize(width, height, lanes);
  choose_windows(votes, windows);
  return windows;
}

/// The cells of a row's costs in its windows; nullptr = all disparities.
inline Buffer<std::uint8_t> cells_of(const reference::RowCosts& costs, const CostWindow* windows) {
  const int width = static_cast<int>(costs.size());
  const int disparities = static_cast<int>(costs[0].size());
  const int lanes = cost_lanes(disparities);
  Buffer<std::uint8_t> cells;
  cells.resize(row_cells(windows, lanes, width));
  std::size_t cell = 0;
  for (int x = 0; x < width; ++x) {
    const CostWindow window = window_at(windows, lanes, x);
    for (int d = window.begin; d < window.end; ++d) {
      cells[cell++] = static_cast<std::uint8_t>(d < disparities ? costs[x][d] : kCensusNever);
    }
  }
  return cells;
}

/// The costs of a row of cells. Those outside of its windows are kOutside.
inline reference::RowCosts costs_of(const std::uint8_t* cells, const CostWindow* windows, int width,
                                    int disparities) {
  reference::RowCosts costs(width, std::vector<int>(disparities, reference::kOutside));
  for (int x = 0; x < width; ++x) {
    const CostWindow window = window_at(windows, cost_lanes(disparities), x);
    for (int d = window.begin; d < window.end; ++d, ++cells) {
      if (d < disparities) costs[x][d] = *cells;
    }
  }
  return costs;
}

/// The same windows for the references.
inline reference::Windows copy_of(const SearchWindows& windows, int width, int height) {
  reference::Windows copy;
  if (windows.row(0) == nullptr) return copy;
  copy.columns = (width + kWindowTile - 1) / kWindowTile;
  for (int y = 0; y < height; y += kWindowTile) {
    copy.tiles.insert(copy.tiles.end(), windows.row(y), windows.row(y) + copy.columns);
  }
  return copy;
}

}  // namespace mtstereo::test
