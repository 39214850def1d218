// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "reference/pixels/disparity_selection.hpp"
#include "reference/pixels/row_pair.hpp"
#include "reference/pixels/search_range.hpp"
#include "reference/prepare/cost_volume.hpp"
#include "stages/pixels/census_matching.hpp"
#include "stages/pixels/pixel_matching.hpp"

namespace mtstereo::reference {

using test::DisparityPlane;

/// A disparity map and its peak ratios.
struct RatedMap {
  RatedMap(int width, int height) : map(width, height), ratio(width, height) {}
  void set(int x, int y, const Selected& selected) {
    map(x, y) = selected.disparity;
    ratio(x, y) = static_cast<std::uint8_t>(selected.ratio);
  }
  DisparityPlane map;
  GrayPlane ratio;
};

inline std::vector<std::int32_t> row_of(const DisparityPlane& map, int y) {
  return {&map(0, y), &map(0, y) + map.width};
}

/// The best of the disparities that are expected at one pixel, from the cost volume.
inline Selected match_pixel(const Volume& volume, const PixelMatchingOptions& options, int x, int y,
                            const std::vector<std::int32_t>& nodes) {
  std::vector<int> costs, candidates;
  for (int d = 0; d < volume.disparities() && d <= x; ++d) costs.push_back(volume.at(x, y, d));
  for (const int d : expected_disparities(nodes, x, options.range)) {
    if (d <= x) candidates.push_back(d);
  }
  if (candidates.empty()) return {};
  const int best = *std::min_element(candidates.begin(), candidates.end(),
                                     [&](int a, int b) { return costs[a] < costs[b]; });
  const auto cost = [&](int column, int d) { return volume.at(column, y, d); };
  const int width = static_cast<int>(nodes.size());
  if (!right_agrees(x, best, width, options.selection, cost)) return {};
  return judge(costs, best, candidates.front(), candidates.back(), options.selection,
               Refinement::kParabola);
}

inline RatedMap match_pixels(const Volume& volume, const PixelMatchingOptions& options,
                             const DisparityPlane& map) {
  RatedMap out(map.width, map.height);
  for (int y = 0; y < map.height; ++y) {
    const std::vector<std::int32_t> nodes = row_of(map, y);
    for (int x = 0; x < map.width; ++x) {
      out.set(x, y, match_pixel(volume, options, x, y, nodes));
    }
  }
  return out;
}

/// Whether no pixel of the 5x5 window has a census bit. The pixels of the border are repeated.
inline bool is_flat(const Plane<std::uint32_t>& census, int x, int y) {
  for (int dy = -2; dy <= 2; ++dy) {
    for (int dx = -2; dx <= 2; ++dx) {
      if (census.clamped(x + dx, y + dy) != 0) return false;
    }
  }
  return true;
}

/// The same with the census cost. Pixels in flat areas get no disparity. The step penalties are
/// scaled by the rows of the window, as the costs are sums over these rows.
inline RatedMap match_pixels_by_census(const GrayPlane& left, const GrayPlane& right,
                                       const CensusMatchingOptions& options,
                                       const DisparityPlane& map, int scales = 2) {
  const CensusCosts costs{census(left, scales), census(right, scales), options.cost};
  const int rows = options.cost.kernel_size;
  const SmoothnessOptions steps = {options.smoothness.small_step * rows,
                                   options.smoothness.large_step * rows};
  RatedMap out(map.width, map.height);
  for (int y = 0; y < map.height; ++y) {
    const std::vector<std::int32_t> nodes = row_of(map, y);
    std::vector<int> low, high;
    RowCosts row(map.width);
    for (int x = 0; x < map.width; ++x) {
      std::vector<int> expected = expected_disparities(nodes, x, options.range);
      if (is_flat(costs.left, x, y)) expected.clear();
      low.push_back(expected.empty() ? 1 : expected.front());
      high.push_back(expected.empty() ? 0 : expected.back());
      for (int d = 0; d < options.cost.disparities; ++d) {
        row[x].push_back(costs.cost(x, y, d, low[x], high[x]));
      }
    }
    const RowCosts sums = path_sums(row, &left(0, y), steps, PathSums::kTwo);
    const std::vector<Selected> selected = select_disparities(sums, options.selection, low, high);
    for (int x = 0; x < map.width; ++x) out.set(x, y, selected[x]);
  }
  return out;
}

}  // namespace mtstereo::reference
