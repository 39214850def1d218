// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>

#include "base/buffer.hpp"
#include "stages/nodes/node_levels.hpp"
#include "stages/nodes/node_pair.hpp"
#include "stages/prepare/census.hpp"
#include "stages/prepare/cost_volume.hpp"
#include "stages/prepare/max_tree.hpp"

namespace mtstereo {

/// Part of step 5 (paper, "Matching cost aggregation"): the cost of a left and a right node.

/// All that the cost of node pairs of one level is computed from.
struct PairCostInput {
  const MaxTrees& left_trees;
  const MaxTrees& right_trees;
  const NodeLevel& left;
  const NodeLevel& right;
  const CostVolume* volume;                  ///< what the intensity cost is taken from,
  const std::array<CensusImage, 2>* census;  ///< or, without a volume, both views' census
  float intensity_weight;                    ///< alpha
};

/// Mean of the cost volume along the left node of row y, at the disparity that goes linearly from
/// the pair's begin disparity to its end disparity, both in 0 .. D - 1 [gray values]. At half
/// resolution every second column is looked at.
float intensity_cost(const CostVolume& volume, int y, const NodePair& pair);

/// Mean of |aL / (aL + aR) - 1/2| over the pair and its ancestors, walked up side by side as far as
/// both trees go, times 225, which brings it to the scale of gray values. aL and aR are the widths.
float context_cost(const MaxTrees& left, const MaxTrees& right, int y, int left_node,
                   int right_node);

/// Costs of single pairs (without neighbors) for the rows around one row, each computed once.
/// Belongs to one thread.
class PairCosts {
 public:
  /// For up to `max_neighbors` rows above and below. Throws std::bad_alloc.
  void resize(int width, int disparities, int max_neighbors);

  /// Forgets everything; the input is that of the rows to come and must outlive them.
  void start(const PairCostInput& input);

  /// Makes the rows y - max_neighbors .. y + max_neighbors ready. Rows rise from call to call.
  void move_to(int y);

  /// The right nodes whose disparities to left node i of row y are possible: first .. last - 1.
  struct Candidates {
    int first, last;
  };
  Candidates candidates(int y, int i) const { return row(y).candidates[i]; }

  /// Cost of the pair i, j of row y, or a negative number where its disparities are not possible.
  float operator()(int y, int i, int j);

 private:
  struct Row {
    Buffer<Candidates> candidates;  ///< of each left node
    Buffer<std::size_t> offset;     ///< of each left node: where its costs begin
    Buffer<float> costs;            ///< kUnknown until asked for
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
  int next_row_ = 0;  ///< the first row that is not ready
};

}  // namespace mtstereo
