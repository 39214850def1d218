// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>

#include "reference/nodes/disparity_drawing.hpp"

namespace mtstereo::reference {

/// The disparities at both ends of a leaf.
struct Line {
  int at_begin, at_end;
};

/// The medians of the map over a leaf and its neighbors, at the begins and at the ends of these
/// leaves; nothing unless both are known.
inline std::optional<Line> line_of(const Level& leaves, const DisparityPlane& map, Place place,
                                   int most) {
  std::vector<int> begins, ends;
  for (const Place& near : surroundings(leaves, place, most)) {
    const LevelNode& leaf = leaves[near.y][near.i];
    if (map(leaf.begin, near.y) != 0) begins.push_back(map(leaf.begin, near.y));
    if (map(leaf.end, near.y) != 0) ends.push_back(map(leaf.end, near.y));
  }
  if (begins.empty() || ends.empty()) return {};
  return Line{lower_median(begins, 0), lower_median(ends, 0)};
}

/// Distance of the ends from the border of a leaf: 2 px if it is wider than 4 px.
inline int inset(const LevelNode& leaf) { return leaf.end - leaf.begin + 1 > 4 ? 2 : 0; }

/// Writes the line of each leaf: along the whole leaf with `end_width` 0, otherwise to that many
/// pixels around each of its ends.
inline DisparityPlane extrapolate(const Level& leaves, const DisparityPlane& map, int most,
                                  int end_width) {
  DisparityPlane out(map.width, map.height);
  for (int y = 0; y < map.height; ++y) {
    for (int i = 0; i < static_cast<int>(leaves[y].size()); ++i) {
      const std::optional<Line> line = line_of(leaves, map, {y, i}, most);
      if (!line) continue;
      const LevelNode& leaf = leaves[y][i];
      if (end_width == 0) {
        draw_node(leaf.begin, leaf.end, line->at_begin, line->at_end, y, out);
        continue;
      }
      const int inside = inset(leaf);
      for (int k = -(end_width / 2); k <= end_width / 2; ++k) {
        const int first = std::clamp(leaf.begin + inside + k, 0, map.width - 1);
        const int last = std::clamp(leaf.end - inside + k, 0, map.width - 1);
        draw_node(first, first, line->at_begin, line->at_begin, y, out);
        draw_node(last, last, line->at_end, line->at_end, y, out);
      }
    }
  }
  return out;
}

}  // namespace mtstereo::reference
