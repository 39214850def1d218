// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>

#include "base/settings.hpp"
#include "reference/node_extrapolation.hpp"
#include "reference/outlier_removal.hpp"
#include "reference/pixel_matching.hpp"

namespace mtstereo::reference {

/// Everything a matcher shows of one frame.
struct Frame {
  std::array<GrayPlane, 2> levels;  ///< the pre-processed views
  Volume volume;
  std::array<DisparityPlane, 5> stages;  ///< in the order of Stage
};

/// The matches of the leaves, level by level.
inline Matches match_levels(const std::array<Trees, 2>& trees, const Volume& volume,
                            const Settings& s, int width, Level& leaves) {
  Level before;
  Matches matches;
  for (int n = 0; n < s.node_levels.count; ++n) {
    const double below = s.max_node_width * width;
    const Level left = select_nodes(trees[0], s.node_levels.level[n], s.min_node_width, below);
    const Level right = select_nodes(trees[1], s.node_levels.level[n], s.min_node_width, below);
    const Intervals intervals = n == 0 ? first_intervals(left, s.disparities)
                                       : finer_intervals(left, before, matches, s.max_neighbors);
    const PairInput input{trees[0], trees[1], left, right, volume, s.intensity_weight};
    matches =
        match_nodes(input, intervals, s.max_neighbors, s.disparities, s.node_confidence, width);
    before = left;
  }
  leaves = before;
  return matches;
}

/// The whole method of the paper on one pair.
inline Frame match_frame(const GrayPlane& left, const GrayPlane& right,
                         const Parameters& parameters) {
  const Settings s(parameters);
  Frame frame;
  const std::array<GrayPlane, 2> medians = {median5(left), median5(right)};
  std::array<Trees, 2> trees;
  for (int side = 0; side < 2; ++side) {
    frame.levels[side] = levels(medians[side], s.gray_levels);
    trees[side] = max_trees(frame.levels[side]);
  }
  frame.volume = cost_volume(cost_input(medians[0]), cost_input(medians[1]), s.disparities,
                             s.cost_kernel_size, s.cost_shift);
  Level leaves;
  const Matches matches = match_levels(trees, frame.volume, s, left.width, leaves);
  frame.stages[0] = draw_matches(leaves, matches, left.width);
  frame.stages[1] = remove_outliers(frame.stages[0], s.outlier_radius);
  frame.stages[2] = extrapolate(leaves, frame.stages[1], s.max_neighbors,
                                s.mode == Mode::kSparse ? s.node_end_width : 0);
  frame.stages[3] = match_pixels(
      frame.volume, {s.search_range.range, s.selection.confidence, s.selection.subpixel},
      frame.stages[2]);
  frame.stages[4] = remove_outliers(frame.stages[3], s.outlier_radius);
  return frame;
}

}  // namespace mtstereo::reference
