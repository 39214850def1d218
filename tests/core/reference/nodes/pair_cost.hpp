// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdlib>

#include "reference/nodes/node_levels.hpp"
#include "reference/prepare/cost_volume.hpp"

namespace mtstereo::reference {

/// The inputs of the costs of one level.
struct PairInput {
  const Trees& left_trees;
  const Trees& right_trees;
  const Level& left;
  const Level& right;
  const Volume& volume;  ///< source of the intensity costs
  float alpha;
};

/// The two integer disparities of a pair.
struct Ends {
  int begin, end;

  bool possible(int disparities) const {
    return begin >= 0 && end >= 0 && begin < disparities && end < disparities;
  }
};

inline Ends ends(const LevelNode& left, const LevelNode& right) {
  return {left.begin - right.begin, left.end - right.end};
}

/// The disparity at `offset` px from the begin of a node whose last column is at `length` px,
/// rounded half up to whole px; the slope has 16 fractional bits.
inline int disparity_along(const Ends& ends, int length, int offset) {
  const long long slope =
      length == 0 ? 0 : (static_cast<long long>(ends.end) - ends.begin) * 65536 / length;
  const long long fixed = static_cast<long long>(ends.begin) * 65536 + slope * offset;
  return static_cast<int>(std::floor(static_cast<double>(fixed) / 65536 + 0.5));
}

/// Mean cost along the left node in gray values.
template <typename Real>
Real intensity_cost(const Volume& volume, int y, const LevelNode& left, const LevelNode& right) {
  const Ends disparities = ends(left, right);
  long sum = 0;
  int count = 0;
  for (int x = left.begin; x <= left.end; x += 1 << volume.shift) {
    sum += volume.at(x, y, disparity_along(disparities, left.end - left.begin, x - left.begin));
    ++count;
  }
  return static_cast<Real>(sum) / static_cast<Real>(count * 16);
}

/// Mean of |aL / (aL + aR) - 1/2| = |aL - aR| / (2 (aL + aR)) over the pair and its ancestors,
/// times 225.
template <typename Real>
Real context_cost(const std::vector<TreeNode>& left, const std::vector<TreeNode>& right, int l,
                  int r) {
  Real sum = 0;
  int count = 0;
  while (l >= 0 && r >= 0) {
    sum += static_cast<Real>(std::abs(left[l].width() - right[r].width())) /
           static_cast<Real>(2 * (left[l].width() + right[r].width()));
    ++count;
    l = left[l].parent;
    r = right[r].parent;
  }
  return sum / static_cast<Real>(count) * 225;
}

template <typename Real>
Real pair_cost(const PairInput& input, int y, int i, int j) {
  const LevelNode& left = input.left[y][i];
  const LevelNode& right = input.right[y][j];
  const Real alpha = input.alpha;
  const Real intensity = intensity_cost<Real>(input.volume, y, left, right);
  return alpha * intensity + (1 - alpha) * context_cost<Real>(input.left_trees[y],
                                                              input.right_trees[y], left.tree_node,
                                                              right.tree_node);
}

}  // namespace mtstereo::reference
