// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/node_extrapolation.hpp"

#include <algorithm>

#include "stages/disparity_drawing.hpp"
#include "stages/neighbors.hpp"

namespace mtstereo {

void LeafDisparities::resize(const NodeLevel& leaves) {
  begin.resize(leaves.node.size());
  end.resize(leaves.node.size());
}

void read_leaf_ends(const NodeLevel& leaves, const Image<std::int32_t>& map, int y0, int y1,
                    LeafDisparities& ends) {
  for (int y = y0; y < y1; ++y) {
    const std::int32_t* row = map.row(y);
    for (int i = 0; i < leaves.count[y]; ++i) {
      const std::ptrdiff_t leaf = y * leaves.stride + i;
      ends.begin[leaf] = row[leaves.begin[leaf]];
      ends.end[leaf] = row[leaves.end[leaf]];
    }
  }
}

void extrapolate_leaves(const NodeLevel& leaves, const LeafDisparities& ends, int max_neighbors,
                        Mode mode, int y0, int y1, Image<std::int32_t>& map) {
  constexpr int kNarrow = 4;  // [px]
  constexpr int kInside = 2;  // [px]
  for (int y = y0; y < y1; ++y) {
    std::int32_t* row = map.row(y);
    std::fill_n(row, map.width(), kNoDisparity);
    for (int i = 0; i < leaves.count[y]; ++i) {
      const std::int32_t at_begin =
          median_over_neighbors(leaves, y, i, max_neighbors, ends.begin.data(), kNoDisparity);
      const std::int32_t at_end =
          median_over_neighbors(leaves, y, i, max_neighbors, ends.end.data(), kNoDisparity);
      if (at_begin == kNoDisparity || at_end == kNoDisparity) continue;
      const std::ptrdiff_t leaf = y * leaves.stride + i;
      const int begin = leaves.begin[leaf];
      const int end = leaves.end[leaf];
      if (mode == Mode::kSemiDense) {
        draw_node(begin, end, at_begin, at_end, row);
        continue;
      }
      const int inside = end - begin + 1 > kNarrow ? kInside : 0;
      draw_node(begin + inside, begin + inside, at_begin, at_begin, row);
      draw_node(end - inside, end - inside, at_end, at_end, row);
    }
  }
}

}  // namespace mtstereo
