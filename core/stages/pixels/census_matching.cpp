// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixels/census_matching.hpp"

#include <algorithm>

namespace mtstereo {

void CensusMatchingScratch::resize(int width, const CensusMatchingOptions& options) {
  const int disparities = options.cost.disparities;
  for (Row& row : rows) {
    row.low.resize(width);
    row.high.resize(width);
    row.costs.resize(static_cast<std::size_t>(width) * cost_lanes(disparities));
    row.candidates.resize(width, disparities);
  }
  texture.resize(width);
  cost.resize(width, options.cost);
  pair.resize(width, disparities);
}

void match_pixels_by_census(GrayView left_image, const CensusImage& left, const CensusImage& right,
                            const CensusMatchingOptions& options, int y0, int y1,
                            CensusMatchingScratch& scratch, Image<std::int32_t>& map,
                            Image<std::uint8_t>& ratio) {
  const int width = left_image.width;
  const int scale = cost_scale(options.cost);
  const int small_step = options.smoothness.small_step * scale;
  const LargeStepTable large_step =
      large_step_table({small_step, options.smoothness.large_step * scale});
  const RunnerUpTable runner_up = runner_up_table(options.selection.confidence);
  const SearchWindows all;
  RowPair pair = {{}, width, small_step, &large_step, all.row(0), PathSums::kTwo};
  start_census_costs(left, right, all, options.cost, y0, scratch.cost);
  for (int y = y0; y < y1; y += 2) {
    const int rows = std::min(2, y1 - y);
    for (int r = 0; r < rows; ++r) {
      CensusMatchingScratch::Row& row = scratch.rows[r];
      std::uint16_t* low = row.low.data();
      std::uint16_t* high = row.high.data();
      find_search_ranges(map.row(y + r), width, options.range, low, high);
      exclude_flat(left, y + r, scratch.texture, low, high);
      census_cost_row(left, right, all, options.cost, y + r, low, high, scratch.cost,
                      row.costs.data());
      pair.rows[r] = {row.costs.data(), left_image.row(y + r), nullptr, nullptr, low, high,
                      &row.candidates};
    }
    if (rows < 2) pair.rows[1] = pair.rows[0];
    match_row_pair(pair, options.selection, runner_up, scratch.pair);
    for (int r = 0; r < rows; ++r) {
      finish_selection(width, options.selection, pair.rows[r].low, pair.rows[r].high,
                       *pair.rows[r].candidates, map.row(y + r), ratio.row(y + r));
    }
  }
}

}  // namespace mtstereo
