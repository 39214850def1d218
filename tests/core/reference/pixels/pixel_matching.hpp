// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "reference/pixels/disparity_selection.hpp"
#include "reference/pixels/row_walk.hpp"
#include "reference/pixels/search_range.hpp"
#include "reference/prepare/cost_volume.hpp"
#include "stages/pixels/pixel_matching.hpp"

namespace mtstereo::reference {

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

}  // namespace mtstereo::reference
