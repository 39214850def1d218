// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/disparity_drawing.hpp"

#include <algorithm>

namespace mtstereo {

void draw_node(int begin, int end, std::int32_t at_begin, std::int32_t at_end, std::int32_t* row) {
  const int length = std::max(end - begin, 1);
  for (int x = begin; x <= end; ++x) {
    const std::int64_t rise = static_cast<std::int64_t>(at_end - at_begin) * (x - begin);
    // A point at infinity is told apart from no disparity by the smallest step.
    const std::int32_t disparity = std::max(at_begin + static_cast<std::int32_t>(rise / length), 1);
    if (disparity <= x * kDisparityOne) row[x] = disparity;
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
