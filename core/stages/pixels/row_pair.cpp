// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixels/row_pair.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <type_traits>

#include "stages/pixels/row_selection.hpp"

#define HWY_TARGET_INCLUDE "stages/pixels/row_pair.cpp"
#include "base/simd.hpp"
#include "stages/pixels/path_lanes-inl.hpp"
#include "stages/pixels/row_selection-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

/// Advances a path by one pixel, and returns its least cost, in every lane.
template <int kVectors>
HWY_INLINE ByteVector advance(const std::uint8_t* costs, const StepCosts& steps,
                              PixelLanes<kVectors>& path) {
  const Bytes d8;
  const auto never = hn::Set(d8, 255);
  auto least = never, previous = never, same = path.get(0);
  for (int i = 0; i < path.count(); ++i) {
    const auto after = i + 1 < path.count() ? path.get(i + 1) : never;
    const auto next = path_costs(d8, hn::LoadU(d8, costs + i * kByteLanes), previous, same, after,
                                 steps.small_step, steps.any, steps.least);
    path.set(i, next);
    least = hn::Min(least, next);
    previous = same;
    same = after;
  }
  return least_of_lanes(d8, least);
}

/// One direction of the walk along both rows.
template <PathSums kSums, bool kSelect>
class PairWalk {
 public:
  PairWalk(const RowPair& pair, const RowSelection (&rows)[2], const RowPairScratch& scratch)
      : pair_(pair),
        rows_{rows[0], rows[1]},
        lanes_(rows[0].lanes),
        paths_(const_cast<std::uint8_t*>(scratch.paths.data())),
        steps_(scratch.steps.data()),
        ends_(const_cast<std::uint8_t*>(scratch.ends.data())),
        small_step_(hn::Set(Bytes(), static_cast<std::uint8_t>(std::min(pair.small_step, 255)))) {}

  HWY_INLINE void run() {
    const int tiles = (pair_.width + kWindowTile - 1) / kWindowTile;
    std::memset(ends_, 0, 2 * lanes_);
    ByteVector least[2] = {hn::Zero(Bytes()), hn::Zero(Bytes())};
    CostWindow before = {0, static_cast<std::uint16_t>(lanes_)};
    for (int i = 0; i < tiles; ++i) {
      const int x0 = (kSelect ? i : tiles - 1 - i) * kWindowTile;
      const CostWindow window = window_at(pair_.windows, lanes_, x0);
      for (int r = 0; r < 2 && i > 0; ++r) extend_lanes(before, window, ends_ + r * lanes_);
      before = window;
      with_vectors<Bytes>(window, [&]<int kVectors>(std::integral_constant<int, kVectors>)
                                      HWY_ATTR { walk_tile<kVectors>(x0, window, least); });
    }
  }

 private:
  template <int kVectors>
  HWY_INLINE void walk_tile(int x0, CostWindow window, ByteVector (&least)[2]) {
    using Lanes = PixelLanes<kVectors>;
    std::uint8_t* ends[2] = {ends_ + window.begin, ends_ + lanes_ + window.begin};
    Lanes paths[2] = {Lanes(ends[0], window), Lanes(ends[1], window)};
    const int pixels = std::min(kWindowTile, pair_.width - x0);
    for (int r = 0; r < 2; ++r) load(ends[r], paths[r]);
    for (int i = 0; i < pixels; ++i) {
      const int x = kSelect ? x0 + i : x0 + pixels - 1 - i;
      for (int r = 0; r < 2; ++r) {
        const std::ptrdiff_t cell = std::ptrdiff_t{x} * lanes_ + window.begin;
        const std::uint8_t large_step = steps_[r * (pair_.width + 1) + x + !kSelect];
        const StepCosts steps = {small_step_, least[r],
                                 hn::SaturatedAdd(least[r], hn::Set(Bytes(), large_step))};
        least[r] = advance(pair_.rows[r].costs + cell, steps, paths[r]);
        std::uint8_t* from_right = paths_ + r * pair_.width * std::ptrdiff_t{lanes_} + cell;
        if constexpr (kSelect) {
          select_sums(r, x, window, cell, paths[r], from_right);
        } else {
          store(paths[r], from_right);
        }
      }
    }
    for (int r = 0; r < 2; ++r) store(paths[r], ends[r]);
  }

  template <int kVectors>
  HWY_INLINE void select_sums(int r, int x, CostWindow window, std::ptrdiff_t cell,
                              const PixelLanes<kVectors>& path, const std::uint8_t* from_right) {
    const Bytes d8;
    const RowSelection& row = rows_[r];
    std::uint8_t* memory = ends_ + 2 * lanes_;
    PixelLanes<kVectors> sums(memory, window);
    const bool at_border = x + 1 < window.end;
    for (int i = 0; i < sums.count(); ++i) {
      const int d = i * kByteLanes;
      const auto other = hn::LoadU(d8, from_right + d);
      auto sum = hn::AverageRound(path.get(i), other);
      if constexpr (kSums == PathSums::kFour) {
        const auto above = hn::LoadU(d8, pair_.rows[r].from_above + cell + d);
        const auto below = hn::LoadU(d8, pair_.rows[r].from_below + cell + d);
        sum = hn::AverageRound(sum, hn::AverageRound(above, below));
      }
      if (at_border) sum = with_border(row, x, window.begin + d, sum);
      sums.set(i, sum);
    }
    store(sums, memory);
    select(row, x, window, sums, memory);
  }

  template <int kVectors>
  HWY_INLINE static void load(const std::uint8_t* from, PixelLanes<kVectors>& lanes) {
    for (int i = 0; i < lanes.count(); ++i) {
      lanes.set(i, hn::LoadU(Bytes(), from + i * kByteLanes));
    }
  }

  template <int kVectors>
  HWY_INLINE static void store(const PixelLanes<kVectors>& lanes, std::uint8_t* to) {
    for (int i = 0; i < lanes.count(); ++i) {
      hn::StoreU(lanes.get(i), Bytes(), to + i * kByteLanes);
    }
  }

  // Copies: the compiler knows that no store of bytes changes them.
  const RowPair pair_;
  const RowSelection rows_[2];
  const int lanes_;
  std::uint8_t* const paths_;
  const std::uint8_t* const steps_;
  std::uint8_t* const ends_;
  const ByteVector small_step_;
};

template <PathSums kSums>
void walk_both_ways(const RowPair& pair, const RowSelection (&rows)[2],
                    const RowPairScratch& scratch) {
  PairWalk<kSums, false>(pair, rows, scratch).run();
  PairWalk<kSums, true>(pair, rows, scratch).run();
}

void walk_pair(const RowPair& pair, const RowSelection (&rows)[2], const RowPairScratch& scratch) {
  switch (pair.sums) {
    case PathSums::kTwo:
      walk_both_ways<PathSums::kTwo>(pair, rows, scratch);
      break;
    case PathSums::kFour:
      walk_both_ways<PathSums::kFour>(pair, rows, scratch);
      break;
  }
  for (const RowSelection& row : rows) {
    if (row.right != nullptr) decide_right(row);
  }
}

/// Selects by the costs of the first row.
void select_by_cost(const RowPair& pair, const RowSelection& of_row, std::uint8_t* memory) {
  const RowSelection row = of_row;
  const Bytes d8;
  for (int x = 0; x < row.width; ++x) {
    const CostWindow window = window_at(pair.windows, row.lanes, x);
    const std::uint8_t* costs = pair.rows[0].costs + std::ptrdiff_t{x} * row.lanes + window.begin;
    with_vectors<Bytes>(window, [&]<int kVectors>(std::integral_constant<int, kVectors>) HWY_ATTR {
      PixelLanes<kVectors> sums(memory, window);
      for (int i = 0; i < sums.count(); ++i) {
        const int d = i * kByteLanes;
        auto cost = hn::LoadU(d8, costs + d);
        if (x + 1 < window.end) cost = with_border(row, x, window.begin + d, cost);
        sums.set(i, cost);
        hn::StoreU(cost, d8, memory + d);
      }
      select(row, x, window, sums, memory);
    });
  }
  if (row.right != nullptr) decide_right(row);
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(walk_pair);
HWY_EXPORT(select_by_cost);

namespace {

/// P2 between the columns of a row, and at both ends.
void find_steps(const RowPair& pair, int r, std::uint8_t* steps) {
  const std::uint8_t* table = pair.large_step->data();
  const std::uint8_t* gray = pair.rows[r].gray;
  steps[0] = steps[pair.width] = table[0];
  for (int x = 1; x < pair.width; ++x) steps[x] = table[std::abs(gray[x] - gray[x - 1])];
}

/// Starts the selection of a row.
RowSelection selection_of(const RowPair& pair, const PathRow& row, const SelectionOptions& options,
                          const RunnerUpTable& runner_up, RowPairScratch& scratch) {
  Candidates& to = *row.candidates;
  const bool checks = options.left_right_tolerance >= 0;
  if (checks) std::memset(to.right.data(), 255, Candidates::kTurns * to.right_stride);
  const int lanes = cost_lanes(options.disparities);
  return {pair.width,
          lanes,
          options.disparities,
          runner_up.data(),
          options.runner_up_in_range ? row.low : nullptr,
          options.runner_up_in_range ? row.high : nullptr,
          scratch.limits.data(),
          scratch.beside.data() + lanes + 1,
          to.best.data(),
          to.least.data(),
          to.second.data(),
          to.before.data(),
          to.after.data(),
          checks ? to.right.data() : nullptr,
          to.right_stride,
          lanes > 256};
}

/// The disparities of the right pixels of the best ones.
void find_other(int width, const SelectionOptions& options, Candidates& candidates) {
  if (options.left_right_tolerance < 0) return;
  const std::uint8_t* low = candidates.decided(Candidates::kLow);
  const std::uint8_t* high = candidates.decided(Candidates::kHigh);
  for (int x = 0; x < width; ++x) {
    const int right = width - 1 - x + candidates.best[x];
    candidates.other[x] = static_cast<std::int16_t>(low[right] + 256 * high[right]);
  }
}

}  // namespace

void RowPairScratch::resize(int width, int disparities) {
  const std::size_t lanes = cost_lanes(disparities);
  paths.resize(2 * width * lanes);
  steps.resize(2 * (width + 1));
  ends.resize(3 * lanes);
  limits.resize(3 * lanes);
  std::memset(limits.data(), 0, 3 * lanes);
  std::memset(limits.data() + lanes, 255, lanes);
  beside.resize(2 * lanes + 2);
  std::memset(beside.data(), 0, beside.size());
  std::memset(beside.data() + lanes, 255, 3);
}

void match_row_pair(const RowPair& pair, const SelectionOptions& options,
                    const RunnerUpTable& runner_up, RowPairScratch& scratch) {
  RowSelection rows[2];
  for (int r = 0; r < 2; ++r) {
    find_steps(pair, r, scratch.steps.data() + r * (pair.width + 1));
    rows[r] = selection_of(pair, pair.rows[r], options, runner_up, scratch);
  }
  HWY_DYNAMIC_DISPATCH(walk_pair)(pair, rows, scratch);
  for (const PathRow& row : pair.rows) find_other(pair.width, options, *row.candidates);
}

void match_row_by_cost(const RowPair& pair, const SelectionOptions& options,
                       const RunnerUpTable& runner_up, RowPairScratch& scratch) {
  const RowSelection row = selection_of(pair, pair.rows[0], options, runner_up, scratch);
  HWY_DYNAMIC_DISPATCH(select_by_cost)(pair, row, scratch.ends.data());
  find_other(pair.width, options, *pair.rows[0].candidates);
}

}  // namespace mtstereo
#endif  // HWY_ONCE
