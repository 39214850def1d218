// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "stages/prepare/max_tree.hpp"

namespace mtstereo {

/// Step 3 (paper, "Matching cost aggregation"): the nodes of one coarseness level, and which of
/// them are neighbors across the rows.

/// The nodes of one level of one view. In a row they never nest and stand from left to right. The
/// nodes of row y stand at first[y] .. first[y] + count[y] - 1; an index counts from there. As in
/// MaxTrees the rows that one call of select_nodes() fills are packed.
struct NodeLevel {
  int width = 0;                ///< of the view [px]
  int height = 0;               ///< of the view [px]
  Buffer<std::uint32_t> first;  ///< of each row, where its nodes begin
  Buffer<int> count;            ///< nodes of each row
  Buffer<std::uint16_t> node;   ///< the node's index in its row of the MaxTrees
  Buffer<std::uint16_t> begin;  ///< first column [px]
  Buffer<std::uint16_t> end;    ///< last column [px]
  Buffer<std::uint16_t> up;     ///< the neighbor one row above, kNoNode where there is none
  Buffer<std::uint16_t> down;   ///< the neighbor one row below, kNoNode where there is none

  void resize(int view_width, int view_height);
  /// Places for nodes, which every column of what is told of nodes has.
  std::size_t size() const { return begin.size(); }
};

/// Finds the nodes of a row of a level that cover columns which are asked for from left to right.
class CoveringNode {
 public:
  CoveringNode(const NodeLevel& level, int y)
      : begin_(level.begin.data() + level.first[y]),
        end_(level.end.data() + level.first[y]),
        count_(level.count[y]) {}

  /// Index of the node that covers column x, kNoNode where none does.
  std::uint16_t at(int x) {
    while (next_ < count_ && end_[next_] < x) ++next_;
    return next_ < count_ && begin_[next_] <= x ? static_cast<std::uint16_t>(next_) : kNoNode;
  }

 private:
  const std::uint16_t* begin_;
  const std::uint16_t* end_;
  int count_;
  int next_ = 0;  ///< the first one that does not end left of the last column
};

/// The widths of the fine top nodes: the leaves that are wider than `above` px and narrower than
/// `below` px (omega_alpha and omega_beta times the image's width).
struct WidthRange {
  double above;
  double below;
};

/// Selects the nodes of a level for the rows y0 .. y1 - 1: the `ancestor`-th ancestor of every fine
/// top node, each once, and without those that are an ancestor of another selected one.
/// Fills everything but `up` and `down`. No two calls for one level may have only a part of their
/// rows in common.
void select_nodes(const MaxTrees& trees, int ancestor, WidthRange widths, int y0, int y1,
                  NodeLevel& level);

/// Finds the neighbors of the nodes of the rows y0 .. y1 - 1: the node one row up (down) that
/// covers the node's center column. Reads the nodes of the rows y0 - 1 .. y1.
void link_neighbors(int y0, int y1, NodeLevel& level);

}  // namespace mtstereo
