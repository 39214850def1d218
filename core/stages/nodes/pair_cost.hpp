// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "base/buffer.hpp"
#include "stages/nodes/node_levels.hpp"
#include "stages/nodes/node_pair.hpp"
#include "stages/prepare/cost_volume.hpp"
#include "stages/prepare/max_tree.hpp"

namespace mtstereo {

/// Part of the step node-matching (paper, "Matching cost aggregation"): the cost of a left and a
/// right node.

/// The input of the costs of one level's node pairs.
struct PairCostInput {
  const MaxTrees& left_trees;
  const MaxTrees& right_trees;
  const NodeLevel& left;
  const NodeLevel& right;
  const CostVolume& volume;  ///< source of the intensity cost
  float intensity_weight;    ///< alpha
};

/// Mean of the cost volume along the left node of row y [gray values], at disparities interpolated
/// linearly between the pair's begin and end disparity, both in 0 .. D - 1. A volume at half
/// resolution is sampled at every second column.
float intensity_cost(const CostVolume& volume, int y, const NodePair& pair);

/// Mean of |aL / (aL + aR) - 1/2| over the pair and its ancestors, which are followed side by side
/// until one tree's root, times 225, which brings it to the scale of gray values. aL and aR are the
/// widths of the two nodes.
float context_cost(const MaxTrees& left, const MaxTrees& right, int y, int left_node,
                   int right_node);

/// Cache of the costs of single pairs (without neighbors) for the rows around one row. Each cost is
/// computed at most once. Scratch memory of one thread.
class PairCosts {
 public:
  /// Reserves `max_neighbors` rows above and below the row. Throws std::bad_alloc.
  void resize(int width, int disparities, int max_neighbors);

  /// Clears the cache and sets the input of the following calls, which must outlive them.
  void start(const PairCostInput& input);

  /// Prepares the rows y - max_neighbors .. y + max_neighbors. y increases from call to call.
  void move_to(int y);

  /// The right nodes with possible disparities to left node i of row y: first .. last - 1.
  struct Candidates {
    int first, last;
  };
  Candidates candidates(int y, int i) const { return row(y).candidates[i]; }

  /// Cost of the pair (i, j) of row y, or a negative number if its disparities are impossible.
  float operator()(int y, int i, int j);

 private:
  struct Row {
    Buffer<Candidates> candidates;  ///< per left node
    Buffer<std::size_t> offset;     ///< per left node: position of its first cost
    Buffer<float> costs;            ///< kUnknown until computed
  };
  Row& row(int y) { return rows_[y % row_count_]; }
  const Row& row(int y) const { return rows_[y % row_count_]; }
  void prepare(int y);
  float compute(int y, int i, int j) const;

  const PairCostInput* input_ = nullptr;
  std::unique_ptr<Row[]> rows_;
  int row_capacity_ = 0;
  int row_count_ = 0;
  int max_neighbors_ = 0;
  int disparities_ = 0;
  int next_row_ = 0;  ///< the first row that is not prepared
};

}  // namespace mtstereo
