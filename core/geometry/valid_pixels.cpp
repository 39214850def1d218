// SPDX-License-Identifier: LGPL-2.1-or-later
#include "geometry/valid_pixels.hpp"

#include <algorithm>
#include <cstddef>

namespace mtstereo {

std::vector<ValidColumns> longest_runs(const std::vector<PixelRun>& runs, int height) {
  std::vector<ValidColumns> columns(static_cast<std::size_t>(height));
  for (const PixelRun& run : runs) {
    ValidColumns& row = columns[static_cast<std::size_t>(run.y)];
    if (run.end - run.begin > row.end - row.begin) row = {run.begin, run.end};
  }
  return columns;
}

PixelRectangle largest_rectangle(const std::vector<ValidColumns>& columns) {
  PixelRectangle best;
  long best_area = 0;
  const auto height = static_cast<int>(columns.size());
  for (int top = 0; top < height; ++top) {
    ValidColumns common = columns[static_cast<std::size_t>(top)];
    for (int bottom = top; bottom < height; ++bottom) {
      const ValidColumns& row = columns[static_cast<std::size_t>(bottom)];
      common = {std::max(common.begin, row.begin), std::min(common.end, row.end)};
      const long width = common.end - common.begin;
      // No rectangle that starts in this row can be larger.
      if (width <= 0 || width * (height - top) <= best_area) break;
      const int rows = bottom - top + 1;
      if (width * rows <= best_area) continue;
      best_area = width * rows;
      best = {common.begin, top, static_cast<int>(width), rows};
    }
  }
  return best;
}

}  // namespace mtstereo
