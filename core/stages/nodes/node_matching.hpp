// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "stages/nodes/node_levels.hpp"
#include "stages/nodes/pair_cost.hpp"

namespace mtstereo {

/// The step node-matching (paper, "Matching cost aggregation"): matches the nodes of one level.

/// The disparity of a node without a match.
inline constexpr std::int16_t kNodeUnmatched = -1;

/// The matches of one level's left nodes, in the layout of NodeLevel's per-node arrays. Either both
/// disparities of a node are known or both are kNodeUnmatched.
struct NodeMatches {
  Buffer<std::int16_t> begin_disparity;  ///< at the node's first column [px]
  Buffer<std::int16_t> end_disparity;    ///< at the node's last column [px]

  void resize(const NodeLevel& left);
};

/// The columns first .. last of the right view within which each left node's partner has to lie;
/// first > last if there is no candidate. The arrays have the layout of NodeLevel's per-node
/// arrays.
struct SearchIntervals {
  Buffer<std::int32_t> first;
  Buffer<std::int32_t> last;

  void resize(const NodeLevel& left);
};

/// The intervals of the coarsest level, for the rows y0 .. y1 - 1: [l - D, l'] for a node [l, l'].
void first_intervals(const NodeLevel& left, int disparities, int y0, int y1,
                     SearchIntervals& intervals);

/// Scratch memory of one thread for finer_intervals(): the intervals of a row of the coarser level.
struct IntervalScratch {
  Buffer<std::int32_t> first;
  Buffer<std::int32_t> last;

  void resize(int width);
};

/// The intervals of a finer level, for the rows y0 .. y1 - 1: [p - nL, p' - nR], where [p, p'] is
/// the node's ancestor in the next coarser level `before`, and nL and nR are the medians of the
/// begin and of the end disparities over the ancestor and its neighbors. The interval is empty if
/// the node has no ancestor there or none of these nodes has a match. `scratch` is resized if it is
/// too small.
void finer_intervals(const NodeLevel& left, const NodeLevel& before, const NodeMatches& matches,
                     int max_neighbors, int y0, int y1, IntervalScratch& scratch,
                     SearchIntervals& intervals);

/// Scratch memory of one thread for match_nodes().
struct MatchScratch {
  /// A node's best partner so far, its cost, and the cost of the second-best one.
  struct Best {
    float cost;
    float second;
    int partner;
  };
  PairCosts costs;
  Buffer<Best> left;
  Buffer<Best> right;

  void resize(int width, int disparities, int max_neighbors);
};

/// Matches the nodes of the rows y0 .. y1 - 1. The cost of a pair is the mean cost of it and its
/// neighbors: the chains of the left and of the right node are followed side by side. A pair is
/// accepted if each node is the other's best partner, the second-best costs of both exceed the best
/// by more than `confidence` (omega_Pi, as a share), and neither node touches the left or right
/// border.
void match_nodes(const PairCostInput& input, const SearchIntervals& intervals, int max_neighbors,
                 float confidence, int y0, int y1, MatchScratch& scratch, NodeMatches& matches);

}  // namespace mtstereo
