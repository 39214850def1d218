// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixels/path_matching.hpp"

#include <algorithm>

#include "stages/pixels/column_optimization.hpp"

namespace mtstereo {
namespace {

/// A chunk y0 .. y1 - 1, and the rows first .. last - 1 that its paths read.
struct Chunk {
  Chunk(int begin, int end, int height)
      : y0(begin),
        y1(end),
        first(std::max(begin - kPathMargin, 0)),
        last(std::min(end + kPathMargin, height)) {}

  int y0, y1, first, last;
};

/// The matching of one chunk.
class ChunkMatching {
 public:
  ChunkMatching(GrayView image, const CensusImage& left, const CensusImage& right,
                const Image<std::int32_t>* half_map, const PathMatchingOptions& options,
                const Chunk& chunk, PathMatchingScratch& scratch)
      : image_(image),
        left_(left),
        right_(right),
        half_map_(half_map),
        options_(options),
        chunk_(chunk),
        scratch_(scratch),
        cells_(static_cast<std::ptrdiff_t>(image.width) * cost_lanes(options.cost.disparities)),
        small_step_(options.smoothness.small_step * cost_scale(options.cost)),
        large_step_(large_step_table(
            {small_step_, options.smoothness.large_step * cost_scale(options.cost)})),
        runner_up_(runner_up_table(options.selection.confidence)) {}

  /// The costs of the chunk and its margins.
  void find_costs() {
    start_census_costs(left_, right_, options_.cost, chunk_.first, scratch_.cost);
    for (int y = chunk_.first; y < chunk_.last; ++y) {
      expect(y);
      census_cost_row(left_, right_, options_.cost, y, scratch_.low.data(), scratch_.high.data(),
                      scratch_.cost, costs(y));
    }
  }

  /// The paths from below. Outside of the chunk only the state is kept.
  void walk_up() {
    const std::uint8_t* before = nullptr;
    for (int y = chunk_.last - 1; y >= chunk_.y0; --y) {
      std::uint8_t* paths = below(std::min(y, chunk_.y1));
      step(y, y + 1, before, paths);
      before = paths;
    }
  }

  /// The paths from above, those along the rows, and the results.
  void walk_down(Image<std::int32_t>& map, Image<std::uint8_t>& ratio) {
    const std::uint8_t* before = nullptr;
    for (int y = chunk_.first; y < chunk_.y1; ++y) {
      step(y, y - 1, before, scratch_.above.data());
      before = scratch_.above.data();
      if (y >= chunk_.y0) select(y, map.row(y), ratio.row(y));
    }
  }

 private:
  std::uint8_t* costs(int y) const { return scratch_.costs.data() + (y - chunk_.first) * cells_; }
  std::uint8_t* below(int y) const { return scratch_.below.data() + (y - chunk_.y0) * cells_; }

  /// Two rows have the same row of the half map.
  void expect(int y) {
    if (expected_ == y / 2) return;
    expected_ = y / 2;
    find_expected(half_map_, y, image_.width, options_.cost.disparities, scratch_.low.data(),
                  scratch_.high.data());
  }

  /// Advances paths along the columns from the row `from` to row y.
  void step(int y, int from, const std::uint8_t* before, std::uint8_t* paths) const {
    const std::uint8_t* gray = image_.row(y);
    const ColumnStep row = {costs(y),
                            gray,
                            before == nullptr ? gray : image_.row(from),
                            image_.width,
                            options_.cost.disparities,
                            small_step_,
                            &large_step_};
    step_columns(row, before, paths, scratch_.least.data());
  }

  void select(int y, std::int32_t* disparity, std::uint8_t* ratio) {
    const int width = image_.width;
    const ScanlineRow row = {costs(y),
                             image_.row(y),
                             width,
                             options_.cost.disparities,
                             small_step_,
                             &large_step_,
                             {scratch_.above.data(), below(y)}};
    const std::uint16_t* low = scratch_.low.data();
    const std::uint16_t* high = scratch_.high.data();
    expect(y);
    start_scanline(row, scratch_.scanline);
    start_selection(scratch_.selection);
    for (int block = 0; block < scanline_blocks(width); ++block) {
      for (const ScanlineSums& part : scanline_block(row, block, scratch_.scanline)) {
        offer_costs(part.sums, part.begin, part.end, width, options_.selection, low, high,
                    scratch_.selection);
      }
    }
    finish_selection(width, options_.selection, low, high, runner_up_, scratch_.selection,
                     disparity, ratio);
  }

  GrayView image_;
  const CensusImage& left_;
  const CensusImage& right_;
  const Image<std::int32_t>* half_map_;
  const PathMatchingOptions& options_;
  Chunk chunk_;
  PathMatchingScratch& scratch_;
  std::ptrdiff_t cells_;  // of a row
  int small_step_;
  LargeStepTable large_step_;
  RunnerUpTable runner_up_;
  int expected_ = -1;  // the row of the half map that the expected range is of
};

}  // namespace

void PathMatchingScratch::resize(int width, int height, const PathMatchingOptions& options) {
  const int disparities = options.cost.disparities;
  const std::size_t cells = static_cast<std::size_t>(width) * cost_lanes(disparities);
  low.resize(width);
  high.resize(width);
  cost.resize(width, options.cost);
  scanline.resize(width, disparities);
  selection.resize(width, disparities);
  costs.resize(cells * std::min(height, kPathRows + 2 * kPathMargin));
  below.resize(cells * (std::min(height, kPathRows) + 1));
  above.resize(cells);
  least.resize(width);
}

void find_expected(const Image<std::int32_t>* half_map, int y, int width, int disparities,
                   std::uint16_t* low, std::uint16_t* high) {
  const int last = disparities - 1;
  if (half_map == nullptr) {
    std::fill_n(low, width, std::uint16_t{0});
    std::fill_n(high, width, static_cast<std::uint16_t>(last));
    return;
  }
  const std::int32_t* half = half_map->row(y / 2);
  for (int x = 0; x < width; x += 2) {
    const std::int32_t disparity = half[x / 2];
    const bool known = disparity != kNoDisparity;
    const int middle = (2 * disparity + kDisparityOne / 2) / kDisparityOne;
    const int first = known ? std::clamp(middle - kPathReach, 0, last) : 0;
    const int second = known ? std::min(middle + kPathReach, last) : last;
    low[x] = static_cast<std::uint16_t>(first);
    high[x] = static_cast<std::uint16_t>(second);
    if (x + 1 == width) break;
    low[x + 1] = low[x];
    high[x + 1] = high[x];
  }
}

void match_along_paths(GrayView left_image, const CensusImage& left, const CensusImage& right,
                       const Image<std::int32_t>* half_map, const PathMatchingOptions& options,
                       int y0, int y1, PathMatchingScratch& scratch, Image<std::int32_t>& map,
                       Image<std::uint8_t>& ratio) {
  scratch.resize(left_image.width, left_image.height, options);
  ChunkMatching matching(left_image, left, right, half_map, options,
                         Chunk(y0, y1, left_image.height), scratch);
  matching.find_costs();
  matching.walk_up();
  matching.walk_down(map, ratio);
}

}  // namespace mtstereo
