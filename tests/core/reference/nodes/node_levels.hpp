// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "reference/prepare/max_tree.hpp"

namespace mtstereo::reference {

/// A node of a level: its columns and its index in the tree of its row.
struct LevelNode {
  int begin, end, tree_node;

  int center() const { return (begin + end) / 2; }
};

/// The nodes of one level, row by row, from left to right.
using Level = std::vector<std::vector<LevelNode>>;

inline bool is_leaf(const std::vector<TreeNode>& tree, int node) {
  return std::none_of(tree.begin(), tree.end(),
                      [&](const TreeNode& other) { return other.parent == node; });
}

inline bool is_ancestor(const std::vector<TreeNode>& tree, int ancestor, int node) {
  for (node = tree[node].parent; node >= 0; node = tree[node].parent) {
    if (node == ancestor) return true;
  }
  return false;
}

/// The n-th ancestors of the leaves that are wider than `above` px and narrower than `below` px,
/// each once, and without nodes that are ancestors of other ones.
inline std::vector<LevelNode> select_row(const std::vector<TreeNode>& tree, int n, double above,
                                         double below) {
  std::set<int> chosen;
  for (int leaf = 0; leaf < static_cast<int>(tree.size()); ++leaf) {
    if (!is_leaf(tree, leaf) || !(tree[leaf].width() > above && tree[leaf].width() < below)) {
      continue;
    }
    int node = leaf;
    for (int step = 0; step < n && node >= 0; ++step) node = tree[node].parent;
    if (node >= 0) chosen.insert(node);
  }
  std::vector<LevelNode> nodes;
  for (const int node : chosen) {
    const bool nests = std::any_of(chosen.begin(), chosen.end(),
                                   [&](int other) { return is_ancestor(tree, node, other); });
    if (!nests) nodes.push_back({tree[node].begin, tree[node].end, node});
  }
  std::sort(nodes.begin(), nodes.end(),
            [](const LevelNode& a, const LevelNode& b) { return a.begin < b.begin; });
  return nodes;
}

inline Level select_nodes(const Trees& trees, int n, double above, double below) {
  Level level;
  for (const auto& tree : trees) level.push_back(select_row(tree, n, above, below));
  return level;
}

/// The node of row y that covers column x, or -1.
inline int covering(const Level& level, int y, int x) {
  if (y < 0 || y >= static_cast<int>(level.size())) return -1;
  for (std::size_t i = 0; i < level[y].size(); ++i) {
    if (level[y][i].begin <= x && x <= level[y][i].end) return static_cast<int>(i);
  }
  return -1;
}

/// A node of a level by its row and its index in the row.
struct Place {
  int y, i;
};

/// The neighbors of a node in one direction (-1 up, 1 down), nearest first, at most `most`.
inline std::vector<Place> neighbors(const Level& level, Place from, int direction, int most) {
  std::vector<Place> chain;
  for (int step = 0; step < most; ++step) {
    const int next = covering(level, from.y + direction,
                              level[from.y][static_cast<std::size_t>(from.i)].center());
    if (next < 0) break;
    from = {from.y + direction, next};
    chain.push_back(from);
  }
  return chain;
}

/// The node itself and its neighbors in both directions.
inline std::vector<Place> surroundings(const Level& level, Place of, int most) {
  std::vector<Place> all = {of};
  for (const int direction : {-1, 1}) {
    const std::vector<Place> chain = neighbors(level, of, direction, most);
    all.insert(all.end(), chain.begin(), chain.end());
  }
  return all;
}

/// The median; of an even number the lower of the two middle values. `none` if there are no values.
inline int lower_median(std::vector<int> values, int none) {
  if (values.empty()) return none;
  std::sort(values.begin(), values.end());
  return values[(values.size() - 1) / 2];
}

}  // namespace mtstereo::reference
