// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/image.hpp"

namespace mtstereo {

/// The step max-trees (paper, "Max-Tree construction"): the Max-tree of every row.

/// "No such node", for any index of a node.
inline constexpr std::uint16_t kNoNode = 0xFFFF;

/// The Max-trees of the rows of one view. A node is a maximal run of pixels whose level is at least
/// the node's; nodes nest, and a node without children is a leaf. The nodes of row y have the
/// positions first[y] .. first[y] + count[y] - 1; a node's index is relative to first[y]. One call
/// of build_max_trees() fills a band of rows, whose nodes are packed. The first one has the
/// position that it would have if every row above had the largest possible number of nodes, so that
/// memory pages without a node are never accessed.
struct MaxTrees {
  int width = 0;                 ///< of the view [px]
  int height = 0;                ///< of the view [px]
  Buffer<std::uint32_t> first;   ///< per row: position of its first node
  Buffer<int> count;             ///< per row: number of its nodes
  Buffer<std::uint16_t> begin;   ///< first column [px]
  Buffer<std::uint16_t> end;     ///< last column [px]
  Buffer<std::uint16_t> parent;  ///< index of the parent, kNoNode for the root

  /// The leaves of each row from left to right, packed like the nodes.
  Buffer<std::uint32_t> first_leaf;
  Buffer<int> leaf_count;
  Buffer<std::uint16_t> leaf;  ///< index of the node

  void resize(int view_width, int view_height);
};

/// Largest number of leaves of a row: at least one pixel separates two leaves.
constexpr int most_leaves(int width) { return (width + 1) / 2; }

/// Builds the trees of the rows y0 .. y1 - 1 of `level` (PreprocessedView::level). The row ranges
/// of two calls for one view are either equal or disjoint.
void build_max_trees(const Image<std::uint8_t>& level, int y0, int y1, MaxTrees& trees);

}  // namespace mtstereo
