// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "stages/max_tree.hpp"

namespace mtstereo {

/// Step 3 (paper, "Matching cost aggregation"): the nodes of one coarseness level, and which of
/// them are neighbors across the rows.

/// The nodes of one level of one view. In a row they never nest and stand from left to right. The
/// nodes of row y stand at y * stride .. y * stride + count[y] - 1; an index counts from there.
struct NodeLevel {
  int width = 0;                ///< of the view [px]
  int height = 0;               ///< of the view [px]
  std::ptrdiff_t stride = 0;    ///< most nodes a row can have
  Buffer<int> count;            ///< nodes of each row
  Buffer<std::uint16_t> node;   ///< the node's index in its row of the MaxTrees
  Buffer<std::uint16_t> begin;  ///< first column [px]
  Buffer<std::uint16_t> end;    ///< last column [px]
  Buffer<std::uint16_t> up;     ///< the neighbor one row above, kNoNode where there is none
  Buffer<std::uint16_t> down;   ///< the neighbor one row below, kNoNode where there is none
  Image<std::uint16_t> label;   ///< of each pixel the node that covers it, or kNoNode

  void resize(int view_width, int view_height);
  /// Index of the center column of node i of row y.
  int center(int y, int i) const { return (begin[y * stride + i] + end[y * stride + i]) / 2; }
};

/// The widths of the fine top nodes: the leaves that are wider than `above` px and narrower than
/// `below` px (omega_alpha and omega_beta times the image's width).
struct WidthRange {
  double above;
  double below;
};

/// Selects the nodes of a level for the rows y0 .. y1 - 1: the `ancestor`-th ancestor of every fine
/// top node, each once, and without those that are an ancestor of another selected one.
/// Fills everything but `up` and `down`. `scratch` is resized to one row.
void select_nodes(const MaxTrees& trees, int ancestor, WidthRange widths, int y0, int y1,
                  Buffer<std::uint8_t>& scratch, NodeLevel& level);

/// Finds the neighbors of the nodes of the rows y0 .. y1 - 1: the node one row up (down) that
/// covers the node's center column. Reads the labels of the rows y0 - 1 .. y1.
void link_neighbors(int y0, int y1, NodeLevel& level);

}  // namespace mtstereo
