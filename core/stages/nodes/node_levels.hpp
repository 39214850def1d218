// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "stages/prepare/max_tree.hpp"

namespace mtstereo {

/// Part of the steps max-trees and node-matching (paper, "Matching cost aggregation"): the nodes of
/// one coarseness level, and their neighbors in adjacent rows.

/// The nodes of one level of one view. The nodes of a row never nest and are sorted from left to
/// right. Those of row y have the positions first[y] .. first[y] + count[y] - 1 in the per-node
/// arrays; a node's index is relative to first[y]. As in MaxTrees, the rows that one call of
/// select_nodes() fills are packed.
struct NodeLevel {
  int width = 0;                ///< of the view [px]
  int height = 0;               ///< of the view [px]
  Buffer<std::uint32_t> first;  ///< per row: position of its first node
  Buffer<int> count;            ///< per row: number of its nodes
  Buffer<std::uint16_t> node;   ///< the node's index in its row of the MaxTrees
  Buffer<std::uint16_t> begin;  ///< first column [px]
  Buffer<std::uint16_t> end;    ///< last column [px]
  Buffer<std::uint16_t> up;     ///< index of the neighbor one row above, or kNoNode
  Buffer<std::uint16_t> down;   ///< index of the neighbor one row below, or kNoNode

  void resize(int view_width, int view_height);
  /// Capacity of every per-node array.
  std::size_t size() const { return begin.size(); }
};

/// Finds the node of a row that covers a given column. Columns have to be queried from left to
/// right.
class CoveringNode {
 public:
  CoveringNode(const NodeLevel& level, int y)
      : begin_(level.begin.data() + level.first[y]),
        end_(level.end.data() + level.first[y]),
        count_(level.count[y]) {}

  /// Index of the node that covers column x, or kNoNode.
  std::uint16_t at(int x) {
    while (next_ < count_ && end_[next_] < x) ++next_;
    return next_ < count_ && begin_[next_] <= x ? static_cast<std::uint16_t>(next_) : kNoNode;
  }

 private:
  const std::uint16_t* begin_;
  const std::uint16_t* end_;
  int count_;
  int next_ = 0;  ///< the first node that does not end left of the last queried column
};

/// The widths of the fine top nodes: leaves wider than `above` px and narrower than `below` px
/// (omega_alpha, and omega_beta times the image's width).
struct WidthRange {
  double above;
  double below;
};

/// Selects the nodes of a level for the rows y0 .. y1 - 1: the `ancestor`-th ancestor of every fine
/// top node, without duplicates and without ancestors of other selected nodes. Fills all fields
/// except `up` and `down`. The row ranges of two calls for one level are either equal or disjoint.
void select_nodes(const MaxTrees& trees, int ancestor, WidthRange widths, int y0, int y1,
                  NodeLevel& level);

/// Finds the neighbors of the nodes of the rows y0 .. y1 - 1: the node one row above (below) that
/// covers the node's center column. Reads the nodes of the rows y0 - 1 .. y1.
void link_neighbors(int y0, int y1, NodeLevel& level);

}  // namespace mtstereo
