// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "reference/disparity_drawing.hpp"

namespace mtstereo::reference {

/// Each leaf takes the medians, over itself and its neighbors, of what the map holds at the leaves'
/// begins and at their ends. Drawn along the leaf with `end_width` 0, else put on that many pixels
/// at its ends, 2 px inside where it is wider than 4 px.
inline DisparityPlane extrapolate(const Level& leaves, const DisparityPlane& map, int most,
                                  int end_width) {
  DisparityPlane out(map.width, map.height);
  for (int y = 0; y < map.height; ++y) {
    for (int i = 0; i < static_cast<int>(leaves[y].size()); ++i) {
      std::vector<int> begins, ends;
      for (const Place& place : surroundings(leaves, {y, i}, most)) {
        const LevelNode& leaf = leaves[place.y][place.i];
        if (map(leaf.begin, place.y) != 0) begins.push_back(map(leaf.begin, place.y));
        if (map(leaf.end, place.y) != 0) ends.push_back(map(leaf.end, place.y));
      }
      if (begins.empty() || ends.empty()) continue;
      const int at_begin = lower_median(begins, 0);
      const int at_end = lower_median(ends, 0);
      const LevelNode& leaf = leaves[y][i];
      if (end_width == 0) {
        draw_node(leaf.begin, leaf.end, at_begin, at_end, y, out);
        continue;
      }
      const int inside = leaf.end - leaf.begin + 1 > 4 ? 2 : 0;
      for (int k = -(end_width / 2); k <= end_width / 2; ++k) {
        const int first = std::clamp(leaf.begin + inside + k, 0, map.width - 1);
        const int last = std::clamp(leaf.end - inside + k, 0, map.width - 1);
        draw_node(first, first, at_begin, at_begin, y, out);
        draw_node(last, last, at_end, at_end, y, out);
      }
    }
  }
  return out;
}

}  // namespace mtstereo::reference
