// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "reference/pixels/pixel_matching.hpp"
#include "reference/pixels/row_pair.hpp"
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
};

/// The costs of all rows.
inline std::vector<RowCosts> path_matching_costs(const PathInput& input,
                                                 const PathMatchingOptions& options) {
  const int width = input.left.width, height = input.left.height;
  const CensusCosts census_costs{census(input.left, input.census_scales),
                                 census(input.right, input.census_scales), options.cost};
  std::vector<RowCosts> costs(height, RowCosts(width));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto [low, high] = expected_at(input.half_map, x, y, options.cost.disparities);
      for (int d = 0; d < options.cost.disparities; ++d) {
        costs[y][x].push_back(census_costs.cost(x, y, d, low, high));
      }
    }
    leave_out(input.windows, y, costs[y]);
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

/// The sums of four paths of row y: those along the columns start kPathMargin rows before and after
/// the row's chunk of kPathRows rows. The path from above alone counts twice.
inline RowCosts four_paths(const PathInput& input, const std::vector<RowCosts>& costs,
                           const SmoothnessOptions& steps, bool both, int y) {
  const GrayPlane& left = input.left;
  const int height = left.height;
  const int y0 = y / kPathRows * kPathRows, y1 = std::min(y0 + kPathRows, height);
  RowCosts above, below;
  for (int row = std::max(y0 - kPathMargin, 0); row <= y; ++row) {
    above = column_step(costs[row], above, &left(0, row), &left(0, std::max(row - 1, 0)), steps);
  }
  for (int row = std::min(y1 + kPathMargin, height) - 1; row >= y; --row) {
    below = column_step(costs[row], below, &left(0, row), &left(0, std::min(row + 1, height - 1)),
                        steps);
  }
  return path_sums(costs[y], &left(0, y), steps, PathSums::kFour, above, both ? below : above);
}

/// Matches a view along two, three or four paths.
inline RatedMap match_along_paths(const PathInput& input, const PathMatchingOptions& options) {
  const int width = input.left.width, height = input.left.height, rows = options.cost.kernel_size;
  const SmoothnessOptions steps = {options.smoothness.small_step * rows,
                                   options.smoothness.large_step * rows};
  const std::vector<RowCosts> costs = path_matching_costs(input, options);
  RatedMap out(width, height);
  for (int y = 0; y < height; ++y) {
    const RowCosts sums =
        options.column_paths == ColumnPaths::kNone
            ? path_sums(costs[y], &input.left(0, y), steps, PathSums::kTwo)
            : four_paths(input, costs, steps, options.column_paths == ColumnPaths::kBoth, y);
    const std::vector<Selected> selected = select_row(input, y, sums, options.selection);
    for (int x = 0; x < width; ++x) out.set(x, y, selected[x]);
  }
  return out;
}

}  // namespace mtstereo::reference
