// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "reference/pixels/pixel_matching.hpp"
#include "reference/pixels/row_walk.hpp"
#include "reference/pixels/search_windows.hpp"
#include "stages/pixels/path_matching.hpp"

namespace mtstereo::reference {

/// The path costs of a row along its columns, from those of the row `before`; an empty one is
/// outside of the image.
inline RowCosts column_step(const RowCosts& costs, const RowCosts& before, const std::uint8_t* gray,
                            const std::uint8_t* gray_before, const SmoothnessOptions& options) {
  if (before.empty()) return costs;
  RowCosts paths;
  for (std::size_t x = 0; x < costs.size(); ++x) {
    // Two pixels of a row are a path as well.
    const std::uint8_t pair[] = {gray_before[x], gray[x]};
    RowCosts both = {before[x], costs[x]};
    paths.push_back(path_costs(both, pair, options, 1)[1]);
  }
  return paths;
}

/// The disparities low .. high that are expected at a pixel.
struct Expected {
  int low, high;
};

inline Expected expected_at(const DisparityPlane* half_map, int x, int y, int disparities) {
  const int half = half_map == nullptr ? 0 : (*half_map)(x / 2, y / 2);
  if (half == 0) return {0, disparities - 1};
  const int middle = (2 * half + 128) / 256;
  return {std::min(std::max(middle - kPathReach, 0), disparities - 1),
          std::min(middle + kPathReach, disparities - 1)};
}

/// What a view is matched from.
struct PathInput {
  const GrayPlane& left;
  const GrayPlane& right;
  const DisparityPlane* half_map;
  Windows windows = {};
  int census_scales = 2;
  const GrayPlane* left_gray = nullptr;  ///< for the cost of gray values; nullptr: without it
  const GrayPlane* right_gray = nullptr;
};

/// The costs of all rows.
inline std::vector<RowCosts> path_matching_costs(const PathInput& input,
                                                 const PathMatchingOptions& options) {
  const int width = input.left.width, height = input.left.height;
  const CensusCosts census_costs{census(input.left, input.census_scales),
                                 census(input.right, input.census_scales), options.cost,
                                 input.left_gray, input.right_gray};
  std::vector<RowCosts> costs(height, RowCosts(width));
  for (int y = 0; y < height; ++y) {
    const RowCosts columns = census_costs.columns(y);
    for (int x = 0; x < width; ++x) {
      const auto [low, high] = expected_at(input.half_map, x, y, options.cost.disparities);
      for (int d = 0; d < options.cost.disparities; ++d) {
        const bool inside = input.windows.contain(x, y, d);
        costs[y][x].push_back(inside ? census_costs.cost(columns, x, y, d, low, high) : kOutside);
      }
    }
  }
  return costs;
}

/// Selects the disparities of row y.
inline std::vector<Selected> select_row(const PathInput& input, int y, const RowCosts& sums,
                                        const SelectionOptions& options) {
  const int width = input.left.width;
  std::vector<int> low(width), high(width);
  for (int x = 0; x < width; ++x) {
    const Expected expected = expected_at(input.half_map, x, y, options.disparities);
    low[x] = expected.low;
    high[x] = expected.high;
  }
  return select_disparities(sums, options, low, high);
}

/// Matches every second row of a view by its costs alone.
inline DisparityPlane match_by_cost(const PathInput& input, const PathMatchingOptions& options) {
  const std::vector<RowCosts> costs = path_matching_costs(input, options);
  const SelectionOptions selection = {options.cost.disparities, 0, false, 1, false, 0};
  DisparityPlane out(input.left.width, input.left.height);
  for (int y = 0; y < out.height; y += 2) {
    const std::vector<Selected> selected = select_row(input, y, twice(costs[y]), selection);
    for (int x = 0; x < out.width; ++x) out(x, y) = selected[x].disparity;
  }
  return out;
}

/// Rows of a chunk: those of the fewest chunks, even in number, rounded up to tiles of 16.
inline int chunk_rows(int height, int most_rows) {
  int chunks = 2;
  while (chunks * most_rows < height) chunks += 2;
  int rows = 16;
  while (chunks * rows < height) rows += 16;
  return rows;
}

/// The paths along the columns in all rows: from above (direction 1) or from below (-1). Each chunk
/// has its own, which start kPathMargin rows before it.
inline std::vector<RowCosts> column_paths(const PathInput& input,
                                          const std::vector<RowCosts>& costs,
                                          const SmoothnessOptions& steps, int chunk,
                                          int direction) {
  const int height = input.left.height;
  std::vector<RowCosts> paths(height);
  for (int y0 = 0; y0 < height; y0 += chunk) {
    const int y1 = std::min(y0 + chunk, height);
    const int rows = y1 - y0 + kPathMargin;
    RowCosts path;
    for (int i = 0; i < rows; ++i) {
      const int y = direction > 0 ? y0 - kPathMargin + i : y1 + kPathMargin - 1 - i;
      if (y < 0 || y >= height) continue;
      const int before = std::clamp(y - direction, 0, height - 1);
      path = column_step(costs[y], path, &input.left(0, y), &input.left(0, before), steps);
      if (y0 <= y && y < y1) paths[y] = path;
    }
  }
  return paths;
}

/// Matches a view along two, three or four paths.
inline RatedMap match_along_paths(const PathInput& input, const PathMatchingOptions& options) {
  const int width = input.left.width, height = input.left.height, rows = options.cost.kernel_size;
  const SmoothnessOptions steps = {options.smoothness.small_step * rows,
                                   options.smoothness.large_step * rows, options.smoothness.edge};
  const std::vector<RowCosts> costs = path_matching_costs(input, options);
  const bool columns = options.column_paths != ColumnPaths::kNone;
  std::vector<RowCosts> above(height), below(height);
  if (columns) {
    const int chunk = chunk_rows(height, options.most_rows);
    above = column_paths(input, costs, steps, chunk, 1);
    // The path from above alone counts twice.
    const bool both = options.column_paths == ColumnPaths::kBoth;
    below = both ? column_paths(input, costs, steps, chunk, -1) : above;
  }
  RatedMap out(width, height);
  for (int y = 0; y < height; ++y) {
    const RowCosts sums = path_sums(costs[y], &input.left(0, y), steps,
                                    columns ? PathSums::kFour : PathSums::kTwo, above[y], below[y]);
    const std::vector<Selected> selected = select_row(input, y, sums, options.selection);
    for (int x = 0; x < width; ++x) out.set(x, y, selected[x]);
  }
  return out;
}

}  // namespace mtstereo::reference
