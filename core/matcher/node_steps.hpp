// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <vector>

#include "base/buffer.hpp"
#include "base/limits.hpp"
#include "matcher/map_steps.hpp"
#include "matcher/view_steps.hpp"
#include "stages/nodes/node_extrapolation.hpp"
#include "stages/nodes/node_levels.hpp"
#include "stages/nodes/node_matching.hpp"
#include "stages/nodes/outlier_removal.hpp"
#include "stages/pixels/pixel_matching.hpp"
#include "stages/prepare/cost_volume.hpp"
#include "stages/prepare/max_tree.hpp"
#include "stages/prepare/median_filter.hpp"
#include "stages/prepare/preprocess.hpp"

/// The steps that match nodes of the Max-trees and the pixels that these guide, and their memory.

namespace mtstereo {

/// One level of S: its nodes and their matches.
struct NodeLevelMatches {
  NodeLevel left;
  NodeLevel right;
  SearchIntervals intervals;
  NodeMatches matches;
};

/// The trees, their nodes and what is found with these. Arrays of two are indexed by Side.
struct Nodes {
  std::array<PreprocessedView, 2> preprocessed;
  std::array<MaxTrees, 2> trees;
  std::array<NodeLevelMatches, kMostNodeLevels> levels;  ///< coarse to fine
  int level_count = 0;                                   ///< number of levels in use
  LeafDisparities ends;                                  ///< of the leaves, the finest level
  VoteMap votes;                                         ///< for the removal of outliers

  struct Scratch {
    MedianScratch median;
    SobelScratch sobel;
    IntervalScratch intervals;
    MatchScratch match;
  };
  std::vector<Scratch> scratch;  ///< one for each thread

  const NodeLevelMatches& leaves() const { return levels[level_count - 1]; }
  void resize(const Settings& settings, const FrameSize& size);
};

/// The cost volume.
struct Costs {
  SmoothingKernel kernel;
  int kernel_size = 0;   ///< the size [px] that the kernel was made for
  int kernel_shift = 0;  ///< the volume's shift that it was made for
  CostVolume volume;

  struct Scratch {
    CostScratch volume;
    PixelMatchingScratch gradient;
  };
  std::vector<Scratch> scratch;  ///< one for each thread

  void resize(const Settings& settings, const FrameSize& size);
};

/// Filters the views and quantizes their gray values.
void preprocess(const StepContext& step, const Views& views, Nodes& nodes);

/// Builds the Max-trees and selects the nodes of all levels.
void build_trees(const StepContext& step, const Views& views, Nodes& nodes);

/// Computes the smoothed cost volume.
void compute_cost_volume(const StepContext& step, const Nodes& nodes, Costs& costs);

/// Matches the nodes of all levels, coarse to fine.
void match_levels(const StepContext& step, const Costs& costs, Nodes& nodes);

/// Draws the matched leaves into the map.
void draw_leaves(const StepContext& step, const Nodes& nodes, Maps& maps);

/// Removes outliers from the map of the drawn nodes, then reads the remaining disparities at the
/// nodes' ends.
void remove_node_outliers(const StepContext& step, Nodes& nodes, Maps& maps);

/// Gives leaves without a match the disparities of their neighbors and draws all leaves.
void extrapolate(const StepContext& step, Nodes& nodes, Maps& maps);

/// Matches the pixels that the nodes guide.
void match_by_gradient(const StepContext& step, Costs& costs, Maps& maps);

/// Removes outliers from the map of the pixels.
void remove_pixel_outliers(const StepContext& step, Nodes& nodes, Maps& maps);

}  // namespace mtstereo
