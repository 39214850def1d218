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
/// y * stride .. y * stride + count[y] - 1; an index of a node counts from the row's first.
struct MaxTrees {
  int width = 0;                 ///< of the view [px]
  int height = 0;                ///< of the view [px]
  std::ptrdiff_t stride = 0;     ///< most nodes a row can have
  Buffer<int> count;             ///< nodes of each row
  Buffer<std::uint16_t> begin;   ///< first column [px]
  Buffer<std::uint16_t> end;     ///< last column [px]
  Buffer<std::uint16_t> parent;  ///< index of the parent, kNoNode for the root

  void resize(int view_width, int view_height);
};

/// Makes the trees of the rows y0 .. y1 - 1 of `level` (PreprocessedView::level).
void build_max_trees(const Image<std::uint8_t>& level, int y0, int y1, MaxTrees& trees);

}  // namespace mtstereo
