// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/nodes/disparity_drawing.hpp"

#include <algorithm>
#include <cstdlib>

namespace mtstereo {

void draw_node(int begin, int end, std::int32_t at_begin, std::int32_t at_end, std::int32_t* row) {
  // The disparity rises by a whole step from column to column, and by one more wherever the
  // accumulated remainder reaches a step.
  const int length = std::max(end - begin, 1);
  const int step = (at_end - at_begin) / length;
  const int part = std::abs((at_end - at_begin) % length);
  const int one = at_end < at_begin ? -1 : 1;
  std::int32_t disparity = at_begin;
  int parts = 0;
  for (int x = begin; x <= end; ++x) {
    const std::int32_t drawn = drawn_disparity(x, disparity);
    if (drawn != kNoDisparity) row[x] = drawn;
    parts += part;
    const bool whole = parts >= length;
    parts -= whole ? length : 0;
    disparity += step + (whole ? one : 0);
  }
}

void draw_matches(const NodeLevel& left, const NodeMatches& matches, int y0, int y1,
                  Image<std::int32_t>& map) {
  for (int y = y0; y < y1; ++y) {
    std::int32_t* row = map.row(y);
    std::fill_n(row, map.width(), kNoDisparity);
    for (int i = 0; i < left.count[y]; ++i) {
      const std::ptrdiff_t node = left.first[y] + i;
      const std::int32_t at_begin = matches.begin_disparity[node];
      if (at_begin == kNodeUnmatched) continue;
      draw_node(left.begin[node], left.end[node], at_begin * kDisparityOne,
                matches.end_disparity[node] * kDisparityOne, row);
    }
  }
}

}  // namespace mtstereo
