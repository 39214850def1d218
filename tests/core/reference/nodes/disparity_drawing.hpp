// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "reference/nodes/node_matching.hpp"

namespace mtstereo::reference {

/// Draws linearly from (begin, at_begin) to (end, at_end), in 1/256 px, rounded towards at_begin. A
/// disparity is at least 1/256 px. A pixel whose column is smaller than its disparity is left out.
inline void draw_node(int begin, int end, int at_begin, int at_end, int y, DisparityPlane& map) {
  for (int x = begin; x <= end; ++x) {
    const long rise = end == begin ? 0L : 1L * (at_end - at_begin) * (x - begin) / (end - begin);
    const int disparity = static_cast<int>(std::max(at_begin + rise, 1L));
    if (disparity <= 256 * x) map(x, y) = disparity;
  }
}

inline DisparityPlane draw_matches(const Level& leaves, const Matches& matches, int width) {
  DisparityPlane map(width, static_cast<int>(leaves.size()));
  for (int y = 0; y < map.height; ++y) {
    for (std::size_t i = 0; i < leaves[y].size(); ++i) {
      const Match& match = matches[y][i];
      if (match.begin < 0) continue;
      draw_node(leaves[y][i].begin, leaves[y][i].end, 256 * match.begin, 256 * match.end, y, map);
    }
  }
  return map;
}

}  // namespace mtstereo::reference
