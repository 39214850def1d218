// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/nodes/node_extrapolation.hpp"

#include <algorithm>

#include "stages/nodes/disparity_drawing.hpp"
#include "stages/nodes/neighbors.hpp"

namespace mtstereo {

void LeafDisparities::resize(const NodeLevel& leaves) {
  begin.resize(leaves.size());
  end.resize(leaves.size());
}

void read_leaf_ends(const NodeLevel& leaves, const Image<std::int32_t>& map, int y0, int y1,
                    LeafDisparities& ends) {
  for (int y = y0; y < y1; ++y) {
    const std::int32_t* row = map.row(y);
    for (int i = 0; i < leaves.count[y]; ++i) {
      const std::ptrdiff_t leaf = leaves.first[y] + i;
      ends.begin[leaf] = row[leaves.begin[leaf]];
      ends.end[leaf] = row[leaves.end[leaf]];
    }
  }
}

void take_match_ends(const NodeLevel& leaves, const NodeMatches& matches, int y0, int y1,
                     LeafDisparities& ends) {
  for (int y = y0; y < y1; ++y) {
    const std::size_t first = leaves.first[y];
    for (std::size_t leaf = first; leaf < first + leaves.count[y]; ++leaf) {
      ends.begin[leaf] = ends.end[leaf] = kNoDisparity;
      if (matches.begin_disparity[leaf] == kNodeUnmatched) continue;
      const int begin = leaves.begin[leaf];
      const int end = leaves.end[leaf];
      ends.begin[leaf] = drawn_disparity(begin, matches.begin_disparity[leaf] * kDisparityOne);
      ends.end[leaf] = end == begin
                           ? ends.begin[leaf]
                           : drawn_disparity(end, matches.end_disparity[leaf] * kDisparityOne);
    }
  }
}

namespace {

/// The disparities that a leaf takes at its ends. It takes none unless both are known.
struct LeafLine {
  std::int32_t at_begin;
  std::int32_t at_end;
  bool known() const { return at_begin != kNoDisparity && at_end != kNoDisparity; }
};

LeafLine line_of(const NodeLevel& leaves, const LeafDisparities& ends, int max_neighbors, int y,
                 int leaf) {
  const EndMedians median = medians_over_neighbors(
      leaves, y, leaf, max_neighbors, ends.begin.data(), ends.end.data(), kNoDisparity);
  return {median.begin, median.end};
}

/// Distance from a leaf's first or last pixel to the middle of the pixels kept there [px].
int inset(int begin, int end) {
  constexpr int kNarrow = 4;
  constexpr int kInside = 2;
  return end - begin + 1 > kNarrow ? kInside : 0;
}

}  // namespace

void extrapolate_leaves(const NodeLevel& leaves, int max_neighbors, int end_width, int y0, int y1,
                        LeafDisparities& ends, Image<std::int32_t>& map) {
  for (int y = y0; y < y1; ++y) {
    std::int32_t* row = map.row(y);
    std::fill_n(row, map.width(), kNoDisparity);
    for (int i = 0; i < leaves.count[y]; ++i) {
      const LeafLine line = line_of(leaves, ends, max_neighbors, y, i);
      if (!line.known()) continue;
      const int begin = leaves.begin[leaves.first[y] + i];
      const int end = leaves.end[leaves.first[y] + i];
      if (end_width == 0) {
        draw_node(begin, end, line.at_begin, line.at_end, row);
        continue;
      }
      const int inside = inset(begin, end);
      for (int k = -(end_width / 2); k <= end_width / 2; ++k) {
        const int first = std::clamp(begin + inside + k, 0, map.width() - 1);
        const int last = std::clamp(end - inside + k, 0, map.width() - 1);
        draw_node(first, first, line.at_begin, line.at_begin, row);
        draw_node(last, last, line.at_end, line.at_end, row);
      }
    }
  }
}

}  // namespace mtstereo
