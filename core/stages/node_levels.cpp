// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/node_levels.hpp"

#include <algorithm>

namespace mtstereo {
namespace {

/// What is known of a node while one row is looked at.
enum NodeMark : std::uint8_t {
  kHasChild = 1,
  kHasSelectedDescendant = 2,
};

/// Lists the ancestors of the fine top nodes of one row in the order of these, without repeating
/// one that follows itself; returns how many.
int list_ancestors(const std::uint16_t* begin, const std::uint16_t* end,
                   const std::uint16_t* parent, int count, int ancestor, WidthRange widths,
                   const std::uint8_t* marks, std::uint16_t* list) {
  int listed = 0;
  for (int node = 0; node < count; ++node) {
    if (marks[node] & kHasChild) continue;
    const int width = end[node] - begin[node] + 1;
    if (!(width > widths.above && width < widths.below)) continue;
    std::uint16_t selected = static_cast<std::uint16_t>(node);
    for (int step = 0; step < ancestor && selected != kNoNode; ++step) selected = parent[selected];
    if (selected == kNoNode || (listed > 0 && list[listed - 1] == selected)) continue;
    list[listed++] = selected;
  }
  return listed;
}

/// Marks all proper ancestors of the listed nodes.
void mark_ancestors(const std::uint16_t* parent, const std::uint16_t* list, int listed,
                    std::uint8_t* marks) {
  for (int i = 0; i < listed; ++i) {
    for (std::uint16_t node = parent[list[i]];
         node != kNoNode && !(marks[node] & kHasSelectedDescendant); node = parent[node]) {
      marks[node] |= kHasSelectedDescendant;
    }
  }
}

}  // namespace

void NodeLevel::resize(int view_width, int view_height) {
  width = view_width;
  height = view_height;
  // A level has at most one node a leaf, and between two leaves there is at least one pixel.
  stride = (view_width + 1) / 2;
  const std::size_t nodes = static_cast<std::size_t>(stride) * view_height;
  count.resize(view_height);
  for (Buffer<std::uint16_t>* column : {&node, &begin, &end, &up, &down}) column->resize(nodes);
  label.resize(view_width, view_height);
}

void select_nodes(const MaxTrees& trees, int ancestor, WidthRange widths, int y0, int y1,
                  Buffer<std::uint8_t>& scratch, NodeLevel& level) {
  scratch.resize(trees.stride);
  std::uint8_t* marks = scratch.data();
  for (int y = y0; y < y1; ++y) {
    const std::uint16_t* begin = trees.begin.data() + y * trees.stride;
    const std::uint16_t* end = trees.end.data() + y * trees.stride;
    const std::uint16_t* parent = trees.parent.data() + y * trees.stride;
    const int count = trees.count[y];
    std::fill_n(marks, count, std::uint8_t{0});
    for (int node = 0; node < count; ++node) {
      if (parent[node] != kNoNode) marks[parent[node]] |= kHasChild;
    }
    const std::ptrdiff_t first = y * level.stride;
    std::uint16_t* list = level.node.data() + first;
    const int listed = list_ancestors(begin, end, parent, count, ancestor, widths, marks, list);
    mark_ancestors(parent, list, listed, marks);

    std::uint16_t* label = level.label.row(y);
    std::fill_n(label, trees.width, kNoNode);
    int kept = 0;
    for (int i = 0; i < listed; ++i) {
      const std::uint16_t node = list[i];
      if (marks[node] & kHasSelectedDescendant) continue;
      // Leaves come from left to right. Between two with the same ancestor there can be one whose
      // ancestor is above that; now that it is dropped, the two follow one another.
      if (kept > 0 && list[kept - 1] == node) continue;
      list[kept] = node;
      level.begin[first + kept] = begin[node];
      level.end[first + kept] = end[node];
      std::fill(label + begin[node], label + end[node] + 1, static_cast<std::uint16_t>(kept));
      ++kept;
    }
    level.count[y] = kept;
  }
}

void link_neighbors(int y0, int y1, NodeLevel& level) {
  for (int y = y0; y < y1; ++y) {
    const std::uint16_t* above = y > 0 ? level.label.row(y - 1) : nullptr;
    const std::uint16_t* below = y + 1 < level.height ? level.label.row(y + 1) : nullptr;
    const std::ptrdiff_t first = y * level.stride;
    for (int i = 0; i < level.count[y]; ++i) {
      const int center = level.center(y, i);
      level.up[first + i] = above != nullptr ? above[center] : kNoNode;
      level.down[first + i] = below != nullptr ? below[center] : kNoNode;
    }
  }
}

}  // namespace mtstereo
