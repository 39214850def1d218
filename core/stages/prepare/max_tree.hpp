// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/image.hpp"

namespace mtstereo {

/// Step 2 (paper, "Max-Tree construction"): the Max-tree of every row.

/// "No such node", wherever a node's index is expected.
inline constexpr std::uint16_t kNoNode = 0xFFFF;

/// The Max-trees of the rows of one view. A node is a maximal run of pixels whose level is at least
/// the node's; nodes nest, and a node without children is a leaf. The nodes of row y stand at
/// first[y] .. first[y] + count[y] - 1; an index of a node counts from the row's first. The rows of
/// a band, which is what one call of build_max_trees() makes, are packed from the place on that
/// they would have if every node there can be were there: pages without a node are never touched.
struct MaxTrees {
  int width = 0;                 ///< of the view [px]
  int height = 0;                ///< of the view [px]
  Buffer<std::uint32_t> first;   ///< of each row, where its nodes begin
  Buffer<int> count;             ///< nodes of each row
  Buffer<std::uint16_t> begin;   ///< first column [px]
  Buffer<std::uint16_t> end;     ///< last column [px]
  Buffer<std::uint16_t> parent;  ///< index of the parent, kNoNode for the root

  /// The leaves of each row from left to right, packed as the nodes are.
  Buffer<std::uint32_t> first_leaf;
  Buffer<int> leaf_count;
  Buffer<std::uint16_t> leaf;  ///< index of the node

  void resize(int view_width, int view_height);
};

/// Most leaves that a row can have: between two there is at least one pixel.
constexpr int most_leaves(int width) { return (width + 1) / 2; }

/// Makes the trees of the rows y0 .. y1 - 1 of `level` (PreprocessedView::level). No two calls for
/// one view may have only a part of their rows in common.
void build_max_trees(const Image<std::uint8_t>& level, int y0, int y1, MaxTrees& trees);

}  // namespace mtstereo
