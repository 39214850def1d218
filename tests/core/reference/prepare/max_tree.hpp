// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <set>
#include <vector>

#include "support/plane.hpp"

namespace mtstereo::reference {

/// A node of one row's Max-tree; `parent` is -1 for the root.
struct TreeNode {
  int begin, end, level, parent;

  int width() const { return end - begin + 1; }
  bool covers(const TreeNode& other) const { return begin <= other.begin && other.end <= end; }
};

/// Thresholds the row at every value that occurs in it and lists the maximal runs that contain the
/// value itself; the parent of a run is the narrowest other run that covers it.
inline std::vector<TreeNode> max_tree(const std::uint8_t* row, int width) {
  std::vector<TreeNode> nodes;
  for (const int level : std::set<int>(row, row + width)) {
    for (int begin = 0; begin < width; ++begin) {
      if (row[begin] < level) continue;
      int end = begin;
      while (end + 1 < width && row[end + 1] >= level) ++end;
      if (*std::min_element(row + begin, row + end + 1) == level) {
        nodes.push_back({begin, end, level, -1});
      }
      begin = end;
    }
  }
  for (TreeNode& node : nodes) {
    int narrowest = width + 1;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (&nodes[i] == &node || !nodes[i].covers(node) || nodes[i].width() >= narrowest) continue;
      node.parent = static_cast<int>(i);
      narrowest = nodes[i].width();
    }
  }
  return nodes;
}

using Trees = std::vector<std::vector<TreeNode>>;

inline Trees max_trees(const test::GrayPlane& levels) {
  Trees trees;
  for (int y = 0; y < levels.height; ++y) trees.push_back(max_tree(&levels(0, y), levels.width));
  return trees;
}

}  // namespace mtstereo::reference
