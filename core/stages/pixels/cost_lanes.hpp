// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace mtstereo {

/// How the costs of a pixel are stored: one byte ("lane") for each disparity, in whole vectors.

/// The number of a pixel's costs is a multiple of this. It is also the size of the widest vectors
/// that every step on costs can use [bytes]; some steps use wider ones if they divide that number.
inline constexpr int kCostStep = 32;

/// Number of a pixel's costs: D rounded up to whole vectors.
inline int cost_lanes(int disparities) {
  return (disparities + kCostStep - 1) / kCostStep * kCostStep;
}

/// The disparities at which a pixel is matched: begin .. end - 1. Both are multiples of
/// kWindowStep, and their difference is one of kCostStep.
struct CostWindow {
  std::uint16_t begin;
  std::uint16_t end;

  int size() const { return end - begin; }
  bool operator==(const CostWindow&) const = default;
};

inline constexpr int kWindowStep = 16;

/// Side of the tiles whose pixels have the same window [px].
inline constexpr int kWindowTile = 16;

/// The window of column x; `windows` has one per tile of the row, nullptr = all lanes.
inline CostWindow window_at(const CostWindow* windows, int lanes, int x) {
  if (windows == nullptr) return {0, static_cast<std::uint16_t>(lanes)};
  return windows[x / kWindowTile];
}

/// A row stores the costs of its pixels one after the other, each pixel's in its window only.
/// Returns how many there are.
inline std::ptrdiff_t row_cells(const CostWindow* windows, int lanes, int width) {
  std::ptrdiff_t cells = 0;
  for (int x = 0; x < width; x += kWindowTile) {
    cells += std::ptrdiff_t{std::min(kWindowTile, width - x)} * window_at(windows, lanes, x).size();
  }
  return cells;
}

/// The smallest window that contains both.
inline CostWindow joined(CostWindow a, CostWindow b) {
  CostWindow both = {std::min(a.begin, b.begin), std::max(a.end, b.end)};
  if (both.size() % kCostStep == 0) return both;
  // All lanes are a multiple of kCostStep, so that there is room on one side.
  if (both.begin > 0) {
    both.begin -= kWindowStep;
  } else {
    both.end += kWindowStep;
  }
  return both;
}

}  // namespace mtstereo
