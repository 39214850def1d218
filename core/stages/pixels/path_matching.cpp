// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixels/path_matching.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "stages/pixels/column_optimization.hpp"

namespace mtstereo {
namespace {

/// Largest difference between the disparities of left and right pixel by their costs alone [px].
constexpr int kCostTolerance = 1;

/// A chunk y0 .. y1 - 1, and the rows first .. last - 1 that its paths read.
struct Chunk {
  Chunk(int begin, int end, ColumnPaths paths, int height)
      : y0(begin),
        y1(end),
        first(paths == ColumnPaths::kNone ? y0 : std::max(y0 - kPathMargin, 0)),
        last(paths == ColumnPaths::kBoth ? std::min(y1 + kPathMargin, height) : y1) {}

  int y0, y1, first, last;
};

/// The matching of one chunk.
class ChunkMatching {
 public:
  ChunkMatching(const PathMatchingInput& input, const PathMatchingOptions& options,
                const Chunk& chunk, PathMatchingScratch& scratch)
      : input_(input),
        options_(options),
        chunk_(chunk),
        scratch_(scratch),
        width_(input.image.width),
        lanes_(cost_lanes(options.cost.disparities)),
        cells_(largest_row()),
        smoothness_({options.smoothness.small_step * cost_scale(options.cost),
                     options.smoothness.large_step * cost_scale(options.cost),
                     options.smoothness.edge}),
        runner_up_(runner_up_table(options.selection.confidence)),
        any_runner_up_(runner_up_table(0)) {}

  /// Writes the results. Paths from below walk through the whole chunk first.
  void run(Image<std::int32_t>& map, Image<std::uint8_t>& ratio, WindowVotes* votes) {
    if (from_below()) {
      walk_up();
    } else {
      start_costs(chunk_.first, RowDirection::kDown);
    }
    if (votes != nullptr) clear_votes(chunk_.y0, chunk_.y1, *votes);
    const std::uint8_t* before = nullptr;
    // Chunks and their margins begin at multiples of kWalkedRows, so that such rows have one row of
    // windows.
    for (int y = chunk_.first; y < chunk_.y1; y += kWalkedRows) {
      const int end = std::min(y + kWalkedRows, chunk_.y1);
      for (int row = y; !from_below() && row < end; row += 2) find_costs(row);
      for (int row = y; from_above() && row < end; ++row) {
        step(row, row - 1, before, above(row));
        before = above(row);
      }
      if (y >= chunk_.y0) match_rows(y, end, map, ratio, votes);
    }
  }

 private:
  bool from_above() const { return options_.column_paths != ColumnPaths::kNone; }
  bool from_below() const { return options_.column_paths == ColumnPaths::kBoth; }

  /// The cells of the largest row of the chunk and its margins.
  std::ptrdiff_t largest_row() const {
    std::ptrdiff_t largest = 0;
    for (int y = chunk_.first; y < chunk_.last; y += kWindowTile) {
      largest = std::max(largest, row_cells(windows(y), lanes_, width_));
    }
    return std::max(largest, row_cells(windows(chunk_.last - 1), lanes_, width_));
  }

  const CostWindow* windows(int y) const { return input_.windows.row(y); }

  /// Without paths from below, the next rows replace these.
  std::uint8_t* costs(int y) const {
    return scratch_.costs.data() + (from_below() ? y - chunk_.first : y % kWalkedRows) * cells_;
  }

  std::uint8_t* above(int y) const { return scratch_.above.data() + y % kWalkedRows * cells_; }

  std::uint8_t* below(int y) const { return scratch_.below.data() + (y - chunk_.y0) * cells_; }

  /// The expected range of a row. Two rows have the same row of the half map.
  const ExpectedRange& expected(int y) {
    const int pair = y / 2, turn = pair % kWalkedPairs;
    ExpectedRange& range = scratch_.expected[turn];
    if (std::exchange(expected_[turn], pair) != pair) {
      find_expected(input_.half_map, y, width_, options_.cost.disparities, range.low.data(),
                    range.high.data());
    }
    return range;
  }

  /// The costs of the rows y and y + 1.
  void find_costs(int y) {
    const ExpectedRange& range = expected(y);
    census_cost_rows(input_.costs, input_.windows, options_.cost, y, range.low.data(),
                     range.high.data(), scratch_.cost, costs(y), costs(y + 1));
  }

  void start_costs(int y, RowDirection direction) {
    start_census_costs(input_.costs, input_.windows, options_.cost, y, direction, scratch_.cost);
  }

  /// Finds the costs of all rows, and advances the paths while they are in the cache. Outside of
  /// the chunk only the state is kept.
  void walk_up() {
    const int last = chunk_.last - 1;
    start_costs(last / 2 * 2, RowDirection::kUp);
    const std::uint8_t* before = nullptr;
    for (int y = last; y >= chunk_.first; --y) {
      if (y == last || y % 2 != 0) find_costs(y / 2 * 2);
      if (y < chunk_.y0) continue;
      std::uint8_t* paths = below(std::min(y, chunk_.y1));
      step(y, y + 1, before, paths);
      before = paths;
    }
  }

  /// Advances paths along the columns from the row `from` to row y.
  void step(int y, int from, const std::uint8_t* before, std::uint8_t* paths) const {
    const int last = before == nullptr ? y : from;
    if (windows(y) != windows(last)) {
      move_columns(windows(last), windows(y), lanes_, width_, before, scratch_.moved.data());
      before = scratch_.moved.data();
    }
    std::uint8_t* large_steps = scratch_.large_steps.data();
    find_large_steps(smoothness_, input_.image.row(y), input_.image.row(last), width_, large_steps);
    const ColumnStep row = {
        costs(y),  large_steps, width_, options_.cost.disparities, smoothness_.small_step,
        windows(y)};
    step_columns(row, before, paths, scratch_.least.data());
  }

  PathRow path_row(int y, Candidates& candidates) {
    const std::uint8_t* upper = from_above() ? above(y) : nullptr;
    const ExpectedRange& range = expected(y);
    return {costs(y),         input_.image.row(y), upper,      from_below() ? below(y) : upper,
            range.low.data(), range.high.data(),   &candidates};
  }

  /// Matches the rows y .. end - 1, at most kWalkedRows.
  void match_rows(int y, int end, Image<std::int32_t>& map, Image<std::uint8_t>& ratio,
                  WindowVotes* votes) {
    WalkedRows rows = {};
    rows.width = width_;
    rows.smoothness = smoothness_;
    rows.windows = windows(y);
    rows.sums = from_above() ? PathSums::kFour : PathSums::kTwo;
    for (int i = 0; i < kWalkedRows; ++i) {
      const int row = std::min(y + i, end - 1);
      rows.of[i] = path_row(row, scratch_.candidates[row - y]);
    }
    match_walked_rows(rows, options_.selection, scratch_.walk);
    for (int row = y; row < end; ++row) {
      const PathRow& matched = rows.of[row - y];
      finish_selection(width_, options_.selection, runner_up_, matched.low, matched.high,
                       *matched.candidates, map.row(row), ratio.row(row));
    }
    if (votes == nullptr) return;
    for (int row = y; row < end; ++row) {
      const bool by_cost = row % kCostVotingRows == 0;
      if (by_cost) select_by_cost(rows, row - y);
      count_votes(map.row(row), by_cost ? scratch_.by_cost.data() : nullptr, width_, row, *votes);
    }
  }

  /// The disparities of row i by its costs alone.
  void select_by_cost(const WalkedRows& rows, int i) {
    const SelectionOptions options = {
        options_.cost.disparities, 0, false, kCostTolerance, false, 0};
    match_row_by_cost(rows, i, options, scratch_.walk);
    const PathRow& row = rows.of[i];
    finish_selection(width_, options, any_runner_up_, row.low, row.high, *row.candidates,
                     scratch_.by_cost.data(), scratch_.by_cost_ratio.data());
  }

  const PathMatchingInput& input_;
  const PathMatchingOptions& options_;
  Chunk chunk_;
  PathMatchingScratch& scratch_;
  int width_;
  int lanes_;
  std::ptrdiff_t cells_;  // from one row of costs to the next
  SmoothnessOptions smoothness_;
  RunnerUpTable runner_up_;
  RunnerUpTable any_runner_up_;
  int expected_[kWalkedPairs] = {-1, -1};  // the rows of the half map that the ranges are of
};

}  // namespace

void PathMatchingScratch::resize(int width, int height, const PathMatchingOptions& options) {
  const int disparities = options.cost.disparities;
  const std::size_t cells = static_cast<std::size_t>(width) * cost_lanes(disparities);
  for (ExpectedRange& range : expected) {
    range.low.resize(width);
    range.high.resize(width);
  }
  cost.resize(width, options.cost);
  walk.resize(width, disparities);
  for (Candidates& row : candidates) row.resize(width, disparities);
  const bool from_below = options.column_paths == ColumnPaths::kBoth;
  const int rows = std::min(height + 1, options.most_rows + 2 * kPathMargin);  // whole pairs
  costs.resize(cells * (from_below ? rows : kWalkedRows));
  below.resize(from_below ? cells * (std::min(height, options.most_rows) + 1) : 0);
  above.resize(options.column_paths == ColumnPaths::kNone ? 0 : kWalkedRows * cells);
  moved.resize(options.column_paths == ColumnPaths::kNone ? 0 : cells);
  least.resize(width);
  large_steps.resize(width);
  by_cost.resize(width);
  by_cost_ratio.resize(width);
}

void find_expected(const Image<std::int32_t>* half_map, int y, int width, int disparities,
                   std::uint16_t* __restrict__ low, std::uint16_t* __restrict__ high) {
  const int last = disparities - 1;
  if (half_map == nullptr) {
    std::fill_n(low, width, std::uint16_t{0});
    std::fill_n(high, width, static_cast<std::uint16_t>(last));
    return;
  }
  const std::int32_t* half = half_map->row(y / 2);
  const auto range = [last](std::int32_t disparity) {
    const bool known = disparity != kNoDisparity;
    const int middle = (2 * disparity + kDisparityOne / 2) / kDisparityOne;
    const int first = known ? std::clamp(middle - kPathReach, 0, last) : 0;
    const int second = known ? std::min(middle + kPathReach, last) : last;
    return std::pair(static_cast<std::uint16_t>(first), static_cast<std::uint16_t>(second));
  };
  // Pairs of columns, so that compilers vectorize the loop.
  for (int i = 0; i < width / 2; ++i) {
    const auto [first, second] = range(half[i]);
    low[2 * i] = low[2 * i + 1] = first;
    high[2 * i] = high[2 * i + 1] = second;
  }
  if (width % 2 != 0) std::tie(low[width - 1], high[width - 1]) = range(half[width / 2]);
}

void match_along_paths(const PathMatchingInput& input, const PathMatchingOptions& options, int y0,
                       int y1, PathMatchingScratch& scratch, Image<std::int32_t>& map,
                       Image<std::uint8_t>& ratio, WindowVotes* votes) {
  scratch.resize(input.image.width, input.image.height, options);
  const Chunk chunk(y0, y1, options.column_paths, input.image.height);
  ChunkMatching(input, options, chunk, scratch).run(map, ratio, votes);
}

}  // namespace mtstereo
