// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixels/census_matching.hpp"

namespace mtstereo {

void CensusMatchingScratch::resize(int width, const CensusMatchingOptions& options) {
  const std::size_t cells = static_cast<std::size_t>(width) * cost_lanes(options.cost.disparities);
  low.resize(width);
  high.resize(width);
  texture.resize(width);
  cost.resize(width, options.cost);
  scanline.resize(width, options.cost.disparities);
  selection.resize(width, options.cost.disparities);
  costs.resize(cells);
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
  const std::uint16_t* low = scratch.low.data();
  const std::uint16_t* high = scratch.high.data();
  const SearchWindows all;
  start_census_costs(left, right, all, options.cost, y0, scratch.cost);
  for (int y = y0; y < y1; ++y) {
    find_search_ranges(map.row(y), width, options.range, scratch.low.data(), scratch.high.data());
    exclude_flat(left, y, scratch.texture, scratch.low.data(), scratch.high.data());
    census_cost_row(left, right, all, options.cost, y, low, high, scratch.cost,
                    scratch.costs.data());
    const ScanlineRow row = {scratch.costs.data(),     left_image.row(y), width,
                             options.cost.disparities, small_step,        &large_step};
    start_scanline(row, scratch.scanline);
    start_selection(scratch.selection);
    for (int block = 0; block < scanline_blocks(width); ++block) {
      for (const ScanlineSums& part : scanline_block(row, block, scratch.scanline)) {
        offer_costs(part.sums, part.begin, part.end, width, options.selection, low, high,
                    all.row(y), scratch.selection);
      }
    }
    finish_selection(width, options.selection, low, high, runner_up, scratch.selection, map.row(y),
                     ratio.row(y));
  }
}

}  // namespace mtstereo
