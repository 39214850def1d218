// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/nodes/node_levels.hpp"

#include <algorithm>
#include <cmath>

namespace mtstereo {
namespace {

/// A WidthRange as whole numbers, both inclusive.
struct WholeWidths {
  explicit WholeWidths(WidthRange range)
      : least(static_cast<int>(std::clamp(std::floor(range.above) + 1, 0.0, kBeyond))),
        most(static_cast<int>(std::clamp(std::ceil(range.below) - 1, 0.0, kBeyond))) {}

  bool hold(int width) const { return width >= least && width <= most; }

  static constexpr double kBeyond = 0x10000;  // [px], wider than any node
  int least;
  int most;
};

/// One row of the trees.
struct Tree {
  Tree(const MaxTrees& trees, int y)
      : begin(trees.begin.data() + trees.first[y]),
        end(trees.end.data() + trees.first[y]),
        parent(trees.parent.data() + trees.first[y]),
        leaf(trees.leaf.data() + trees.first_leaf[y]),
        leaves(trees.leaf_count[y]) {}

  const std::uint16_t* begin;
  const std::uint16_t* end;
  const std::uint16_t* parent;
  const std::uint16_t* leaf;
  int leaves;
};

/// The output of one row of a level.
struct LevelRow {
  std::uint16_t* node;
  std::uint16_t* begin;
  std::uint16_t* end;
};

/// Selects the leaves themselves, which never nest. Returns their number.
int select_leaves(const Tree& tree, WholeWidths widths, LevelRow row) {
  int kept = 0;
  for (int i = 0; i < tree.leaves; ++i) {
    const std::uint16_t node = tree.leaf[i];
    const std::uint16_t begin = tree.begin[node];
    const std::uint16_t end = tree.end[node];
    row.node[kept] = node;
    row.begin[kept] = begin;
    row.end[kept] = end;
    kept += widths.hold(end - begin + 1);
  }
  return kept;
}

/// Selects the ancestors of the fine top nodes. Returns their number.
int select_ancestors(const Tree& tree, int ancestor, WholeWidths widths, LevelRow row) {
  int kept = 0;
  for (int i = 0; i < tree.leaves; ++i) {
    std::uint16_t node = tree.leaf[i];
    if (!widths.hold(tree.end[node] - tree.begin[node] + 1)) continue;
    for (int step = 0; step < ancestor && node != kNoNode; ++step) node = tree.parent[node];
    if (node == kNoNode) continue;
    // Leaves are visited from left to right and nodes nest. So only the last selected node can
    // contain this one; and if this one contains or equals any selected node, it contains or equals
    // the last one.
    const std::uint16_t begin = tree.begin[node];
    const std::uint16_t end = tree.end[node];
    if (kept > 0 && begin <= row.begin[kept - 1] && end >= row.end[kept - 1]) continue;
    if (kept > 0 && end <= row.end[kept - 1]) --kept;
    row.node[kept] = node;
    row.begin[kept] = begin;
    row.end[kept] = end;
    ++kept;
  }
  return kept;
}

}  // namespace

void NodeLevel::resize(int view_width, int view_height) {
  width = view_width;
  height = view_height;
  // A level has at most one node per leaf.
  const std::size_t nodes = static_cast<std::size_t>(most_leaves(view_width)) * view_height;
  first.resize(view_height);
  count.resize(view_height);
  for (Buffer<std::uint16_t>* column : {&node, &begin, &end, &up, &down}) column->resize(nodes);
}

void select_nodes(const MaxTrees& trees, int ancestor, WidthRange widths, int y0, int y1,
                  NodeLevel& level) {
  const WholeWidths whole(widths);
  std::uint32_t first = static_cast<std::uint32_t>(y0) * most_leaves(trees.width);
  for (int y = y0; y < y1; ++y) {
    const Tree tree(trees, y);
    const LevelRow row = {level.node.data() + first, level.begin.data() + first,
                          level.end.data() + first};
    level.first[y] = first;
    level.count[y] = ancestor == 0 ? select_leaves(tree, whole, row)
                                   : select_ancestors(tree, ancestor, whole, row);
    first += level.count[y];
  }
}

namespace {

/// Finds the nodes of row `to` that cover the center columns of the nodes of row y.
void link_rows(const NodeLevel& level, int y, int to, Buffer<std::uint16_t>& link) {
  const std::uint32_t first = level.first[y];
  const std::uint32_t last = first + level.count[y];
  if (to < 0 || to >= level.height) {
    std::fill(link.data() + first, link.data() + last, kNoNode);
    return;
  }
  CoveringNode covering(level, to);
  for (std::uint32_t i = first; i < last; ++i) {
    link[i] = covering.at((level.begin[i] + level.end[i]) / 2);
  }
}

}  // namespace

void link_neighbors(int y0, int y1, NodeLevel& level) {
  for (int y = y0; y < y1; ++y) {
    link_rows(level, y, y - 1, level.up);
    link_rows(level, y, y + 1, level.down);
  }
}

}  // namespace mtstereo
