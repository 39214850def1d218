// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/buffer.hpp"
#include "base/limits.hpp"
#include "matcher/map_steps.hpp"
#include "matcher/view_steps.hpp"
#include "stages/nodes/node_extrapolation.hpp"
#include "stages/nodes/node_levels.hpp"
#include "stages/nodes/node_matching.hpp"
#include "stages/nodes/outlier_removal.hpp"
#include "stages/pixels/census_matching.hpp"
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
  Image<std::uint8_t> foreground;                        ///< 1 where something nearer is in a gap

  struct Scratch {
    MedianScratch median;
    SobelScratch sobel;
    IntervalScratch intervals;
    MatchScratch match;
    Buffer<std::uint8_t> marks;    ///< a row
    Buffer<std::int32_t> columns;  ///< a block of columns
  };
  std::vector<Scratch> scratch;  ///< one for each thread

  const NodeLevelMatches& leaves() const { return levels[level_count - 1]; }
  void resize(const Settings& settings, const FrameSize& size);
};

/// The costs of pixels: the cost volume (gradient cost), or a few rows of census costs in the
/// scratch memory of each thread.
struct Costs {
  SmoothingKernel kernel;
  int kernel_size = 0;   ///< the size [px] that the kernel was made for
  int kernel_shift = 0;  ///< the volume's shift that it was made for
  CostVolume volume;

  struct Scratch {
    CostScratch volume;
    CensusMatchingScratch census;
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
void match_levels(const StepContext& step, const Views& views, const Costs& costs, Nodes& nodes);

/// Draws the matched leaves into the map.
void draw_leaves(const StepContext& step, const Nodes& nodes, Maps& maps);

/// Removes outliers from the map of the drawn nodes, then reads the remaining disparities at the
/// nodes' ends.
void remove_node_outliers(const StepContext& step, Nodes& nodes, Maps& maps);

/// Gives leaves without a match the disparities of their neighbors and draws all leaves.
void extrapolate(const StepContext& step, Nodes& nodes, Maps& maps);

/// Match the pixels that the nodes guide, by one of the two costs.
void match_by_census(const StepContext& step, const Views& views, Costs& costs, Maps& maps);
void match_by_gradient(const StepContext& step, Costs& costs, Maps& maps);

/// Removes outliers from the map of the pixels.
void remove_pixel_outliers(const StepContext& step, Nodes& nodes, Maps& maps);

/// Rates the confidence and removes pixels of low confidence and, in mode sparse, those that are
/// not at the ends of leaves.
void rate_node_confidence(const StepContext& step, Nodes& nodes, Maps& maps);

/// Removes small islands of areas whose other pixels had a low confidence.
void remove_islands(const StepContext& step, Maps& maps);

/// Gives pixels of thin structures their disparities back where the filters have removed them.
void restore_thin_structures(const StepContext& step, Maps& maps);

/// Fills small gaps in surfaces.
void fill_gaps(const StepContext& step, Nodes& nodes, Maps& maps);

/// Removes filled pixels where the matching had seen something nearer.
void check_foreground(const StepContext& step, Nodes& nodes, Maps& maps);

}  // namespace mtstereo
