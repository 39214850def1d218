// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/max_tree.hpp"

namespace mtstereo {
namespace {

/// Where the nodes of one row go.
struct RowNodes {
  std::uint16_t* begin;
  std::uint16_t* end;
  std::uint16_t* parent;
};

/// Builds one row's tree from left to right. The open nodes, whose end is not known yet, form a
/// stack of rising levels; a fall of the level closes nodes. Returns the number of nodes.
int build_row(const std::uint8_t* level, int width, RowNodes nodes) {
  struct Open {
    std::uint16_t node;
    std::uint8_t level;
  };
  Open stack[257];  // levels are 8-bit, so there are never more open nodes than 256
  int depth = 0;
  int count = 0;

  const auto open = [&](int begin, std::uint8_t at_level) {
    nodes.begin[count] = static_cast<std::uint16_t>(begin);
    stack[depth++] = {static_cast<std::uint16_t>(count++), at_level};
  };

  open(0, level[0]);
  for (int x = 1; x < width; ++x) {
    const std::uint8_t now = level[x];
    if (now == level[x - 1]) continue;
    if (now > stack[depth - 1].level) {
      open(x, now);
      continue;
    }
    while (now < stack[depth - 1].level) {
      const std::uint16_t closed = stack[--depth].node;
      nodes.end[closed] = static_cast<std::uint16_t>(x - 1);
      // The component goes on at the new level: as the next open node, or as one not seen so far.
      if (depth == 0 || stack[depth - 1].level < now) open(nodes.begin[closed], now);
      nodes.parent[closed] = stack[depth - 1].node;
    }
  }
  while (depth > 0) {
    const std::uint16_t closed = stack[--depth].node;
    nodes.end[closed] = static_cast<std::uint16_t>(width - 1);
    nodes.parent[closed] = depth > 0 ? stack[depth - 1].node : kNoNode;
  }
  return count;
}

}  // namespace

void MaxTrees::resize(int view_width, int view_height) {
  width = view_width;
  height = view_height;
  // Every node begins at a change of level of its own.
  stride = view_width;
  const std::size_t nodes = static_cast<std::size_t>(stride) * view_height;
  count.resize(view_height);
  begin.resize(nodes);
  end.resize(nodes);
  parent.resize(nodes);
}

void build_max_trees(const Image<std::uint8_t>& level, int y0, int y1, MaxTrees& trees) {
  for (int y = y0; y < y1; ++y) {
    const std::ptrdiff_t first = y * trees.stride;
    trees.count[y] = build_row(
        level.row(y), trees.width,
        {trees.begin.data() + first, trees.end.data() + first, trees.parent.data() + first});
  }
}

}  // namespace mtstereo
