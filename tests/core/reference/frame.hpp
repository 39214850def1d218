// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>

#include "base/settings.hpp"
#include "reference/nodes/node_extrapolation.hpp"
#include "reference/nodes/outlier_removal.hpp"
#include "reference/pixels/pixel_matching.hpp"
#include "reference/prepare/halving.hpp"
#include "reference/refine/confidence.hpp"
#include "reference/refine/disparity_refinement.hpp"
#include "reference/refine/enlarging.hpp"
#include "reference/refine/gap_filling.hpp"
#include "reference/refine/map_smoothing.hpp"
#include "reference/refine/rim_trimming.hpp"
#include "reference/refine/speckle_removal.hpp"

namespace mtstereo::reference {

/// Everything a matcher shows of one frame.
struct Frame {
  std::array<GrayPlane, 2> levels;  ///< the pre-processed views
  Volume volume;
  std::array<DisparityPlane, 5> stages;  ///< in the order of Stage
  DisparityPlane map;                    ///< the result
  GrayPlane confidence;
};

/// The matches of the leaves, level by level.
inline Matches match_levels(const std::array<Trees, 2>& trees, const Volume& volume,
                            const CensusPair& census, const Settings& s, int width, Level& leaves) {
  Level before;
  Matches matches;
  for (int n = 0; n < s.node_levels.count; ++n) {
    const double below = s.max_node_width * width;
    const Level left = select_nodes(trees[0], s.node_levels.level[n], s.min_node_width, below);
    const Level right = select_nodes(trees[1], s.node_levels.level[n], s.min_node_width, below);
    const Intervals intervals = n == 0 ? first_intervals(left, s.disparities)
                                       : finer_intervals(left, before, matches, s.max_neighbors);
    const PairInput input{
        trees[0], trees[1],          left, right, s.node_census ? nullptr : &volume,
        &census,  s.intensity_weight};
    matches =
        match_nodes(input, intervals, s.max_neighbors, s.disparities, s.node_confidence, width);
    before = left;
  }
  leaves = before;
  return matches;
}

/// Guided pixel matching by the one or the other cost.
inline RatedMap match_pixels(const GrayPlane& left, const GrayPlane& right, const Volume& volume,
                             const Settings& s, const DisparityPlane& nodes) {
  if (!s.census) return match_pixels(volume, {s.search_range, s.selection}, nodes);
  return match_pixels_by_census(left, right,
                                {s.search_range, s.census_cost, s.smoothness, s.selection}, nodes);
}

/// What is kept of the pixels' disparities, and how sure it is.
inline ConfidentMap refine(const RatedMap& pixels, const Level& leaves,
                           const DisparityPlane& filtered_nodes, const Settings& s) {
  ConfidentMap out;
  out.map = s.pixel_outliers ? remove_outliers(pixels.map, s.outlier_radius) : pixels.map;
  out.map = remove_speckles(out.map, 256, s.speckle_size);
  out.confidence = rate_support(out.map, pixels.ratio);
  const auto keep_where = [&](auto&& keep) {
    for (std::size_t i = 0; i < out.map.pixels.size(); ++i) {
      if (!keep(i)) out.map.pixels[i] = out.confidence.pixels[i] = 0;
    }
  };
  keep_where([&](std::size_t i) { return out.confidence.pixels[i] >= s.min_confidence; });
  if (s.rim_trim > 0) {
    const DisparityPlane trimmed = trim_rim(out.map, s.rim_trim);
    keep_where([&](std::size_t i) { return trimmed.pixels[i] != 0; });
  }
  if (s.mode == Mode::kSparse && s.census) {
    const Plane<int> ends = leaf_ends(leaves, filtered_nodes, s.max_neighbors, s.node_end_width);
    keep_where([&](std::size_t i) { return ends.pixels[i] != 0; });
  }
  out = fill_gaps(out, s.max_gap, 256, 1, 0);
  out = fill_gaps(out, s.max_gap, 256, 0, 1);
  out.map = smooth(out.map, s.smoothing_radius);
  return out;
}

/// The method on a pair as it is.
inline Frame match_views(const GrayPlane& left, const GrayPlane& right, const Settings& s) {
  Frame frame;
  const std::array<GrayPlane, 2> medians = {median5(left), median5(right)};
  std::array<Trees, 2> trees;
  for (int side = 0; side < 2; ++side) {
    frame.levels[side] = levels(medians[side], s.gray_levels);
    trees[side] = max_trees(frame.levels[side]);
  }
  if (s.needs_volume())
    frame.volume = cost_volume(cost_input(s.median_in_costs ? medians[0] : left),
                               cost_input(s.median_in_costs ? medians[1] : right), s.disparities,
                               s.cost_kernel_size, s.cost_shift);
  Level leaves;
  const Matches matches =
      match_levels(trees, frame.volume, {census(left), census(right)}, s, left.width, leaves);
  frame.stages[0] = draw_matches(leaves, matches, left.width);
  frame.stages[1] = remove_outliers(frame.stages[0], s.outlier_radius);
  const bool only_ends = s.mode == Mode::kSparse && !s.census;
  frame.stages[2] =
      extrapolate(leaves, frame.stages[1], s.max_neighbors, only_ends ? s.node_end_width : 0);
  const RatedMap pixels = match_pixels(left, right, frame.volume, s, frame.stages[2]);
  frame.stages[3] = pixels.map;
  const ConfidentMap result = refine(pixels, leaves, frame.stages[1], s);
  frame.stages[4] = frame.map = result.map;
  frame.confidence = result.confidence;
  return frame;
}

/// The whole method on one pair.
inline Frame match_frame(const GrayPlane& left, const GrayPlane& right,
                         const Parameters& parameters) {
  const Settings s(parameters);
  if (!s.half) return match_views(left, right, s);
  Frame frame = match_views(halve(left), halve(right), s);
  frame.map = enlarge(frame.map, left.width, left.height, s.max_disparity);
  if (s.refined) frame.map = refine(census(left), census(right), frame.map, s.max_disparity);
  frame.confidence = enlarge_confidence(frame.confidence, left.width, left.height);
  return frame;
}

}  // namespace mtstereo::reference
