// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixels/row_pair.hpp"

#include <algorithm>
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
    least = i == 0 ? next : hn::Min(least, next);
    previous = same;
    same = after;
  }
  return least_of_lanes(d8, least);
}

/// One direction of the walk along both rows.
template <PathSums kSums, bool kSelect>
class PairWalk {
 public:
  PairWalk(const RowPair& pair, const RowSelection (&rows)[2], RowPairScratch& scratch)
      : pair_(pair),
        rows_{rows[0], rows[1]},
        lanes_(rows[0].lanes),
        paths_(scratch.paths.data()),
        large_step_(pair.large_step->data()),
        changes_(scratch.changes.data()),
        ends_(scratch.ends.data()),
        scratch_(scratch),
        small_step_(hn::Set(Bytes(), static_cast<std::uint8_t>(std::min(pair.small_step, 255)))) {}

  HWY_INLINE void run() {
    const int tiles = (pair_.width + kWindowTile - 1) / kWindowTile;
    std::memset(ends_, 0, 2 * lanes_);
    ByteVector least[2] = {hn::Zero(Bytes()), hn::Zero(Bytes())};
    CostWindow before = {0, static_cast<std::uint16_t>(lanes_)};
    // The cell after those of the last tile.
    std::ptrdiff_t cell = kSelect ? 0 : row_cells(pair_.windows, lanes_, pair_.width);
    for (int i = 0; i < tiles; ++i) {
      const int x0 = (kSelect ? i : tiles - 1 - i) * kWindowTile;
      const CostWindow window = window_at(pair_.windows, lanes_, x0);
      for (int r = 0; r < 2 && i > 0; ++r) extend_lanes(before, window, ends_ + r * lanes_);
      before = window;
      with_vectors<Bytes>(window, [&]<int kVectors>(std::integral_constant<int, kVectors>)
                                      HWY_ATTR { walk_tile<kVectors>(x0, window, cell, least); });
    }
  }

 private:
  template <int kVectors>
  HWY_INLINE void walk_tile(int x0, CostWindow window, std::ptrdiff_t& cell,
                            ByteVector (&last_least)[2]) {
    using Lanes = PixelLanes<kVectors>;
    std::uint8_t* ends[2] = {ends_ + window.begin, ends_ + lanes_ + window.begin};
    Lanes paths[2] = {Lanes(ends[0], window), Lanes(ends[1], window)};
    const int pixels = std::min(kWindowTile, pair_.width - x0);
    // In registers.
    ByteVector least[2] = {last_least[0], last_least[1]};
    std::uint8_t* const sums[2] = {scratch_.sums_of(0, window.size()),
                                   scratch_.sums_of(1, window.size())};
    for (int i = 0; i < pixels; ++i) {
      const int x = kSelect ? x0 + i : x0 + pixels - 1 - i;
      if constexpr (!kSelect) cell -= window.size();
      for (int r = 0; r < 2; ++r) {
        const std::uint8_t change = changes_[r * (pair_.width + 1) + x + !kSelect];
        const StepCosts steps = {small_step_, least[r],
                                 hn::SaturatedAdd(least[r], hn::Set(Bytes(), large_step_[change]))};
        least[r] = advance(pair_.rows[r].costs + cell, steps, paths[r]);
        std::uint8_t* from_right = paths_ + r * pair_.width * std::ptrdiff_t{lanes_} + cell;
        if constexpr (kSelect) {
          add_up(r, x, window, cell, paths[r], from_right, sums[r]);
        } else {
          store(paths[r], from_right);
        }
      }
      if constexpr (!kSelect) continue;
      cell += window.size();
      const std::ptrdiff_t place = right_place(rows_[0], x);
      for (int r = 0; r < 2; ++r) select<kVectors>(rows_[r], x, place, window, sums[r]);
    }
    for (int r = 0; r < 2; ++r) {
      store(paths[r], ends[r]);
      last_least[r] = least[r];
    }
  }

  template <int kVectors>
  HWY_INLINE void add_up(int r, int x, CostWindow window, std::ptrdiff_t cell,
                         const PixelLanes<kVectors>& path, const std::uint8_t* from_right,
                         std::uint8_t* sums) {
    const Bytes d8;
    const bool at_border = x + 1 < window.end;
    for (int i = 0; i < path.count(); ++i) {
      const int d = i * kByteLanes;
      const auto other = hn::LoadU(d8, from_right + d);
      auto sum = hn::AverageRound(path.get(i), other);
      if constexpr (kSums == PathSums::kFour) {
        const auto above = hn::LoadU(d8, pair_.rows[r].from_above + cell + d);
        const auto below = hn::LoadU(d8, pair_.rows[r].from_below + cell + d);
        sum = hn::AverageRound(sum, hn::AverageRound(above, below));
      }
      if (at_border) sum = with_border(rows_[r], x, window.begin + d, sum);
      hn::StoreU(sum, d8, sums + d);
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
  const std::uint8_t* const large_step_;
  const std::uint8_t* const changes_;
  std::uint8_t* const ends_;
  RowPairScratch& scratch_;
  const ByteVector small_step_;
};

template <PathSums kSums>
void walk_both_ways(const RowPair& pair, const RowSelection (&rows)[2], RowPairScratch& scratch) {
  PairWalk<kSums, false>(pair, rows, scratch).run();
  PairWalk<kSums, true>(pair, rows, scratch).run();
}

void walk_pair(const RowPair& pair, const RowSelection (&rows)[2], RowPairScratch& scratch) {
  switch (pair.sums) {
    case PathSums::kTwo:
      walk_both_ways<PathSums::kTwo>(pair, rows, scratch);
      break;
    case PathSums::kFour:
      walk_both_ways<PathSums::kFour>(pair, rows, scratch);
      break;
  }
  for (const RowSelection& row : rows) decide_right(row);
}

/// Selects by the costs of the first row.
void select_by_cost(const RowPair& pair, const RowSelection& of_row, RowPairScratch& scratch) {
  const RowSelection row = of_row;
  const Bytes d8;
  const std::uint8_t* costs = pair.rows[0].costs;
  for (int x0 = 0; x0 < row.width; x0 += kWindowTile) {
    const CostWindow window = window_at(pair.windows, row.lanes, x0);
    std::uint8_t* const memory = scratch.sums_of(0, window.size());
    with_vectors<Bytes>(window, [&]<int kVectors>(std::integral_constant<int, kVectors>) HWY_ATTR {
      for (int x = x0; x < std::min(x0 + kWindowTile, row.width); ++x) {
        for (int i = 0; i < window.size(); i += kByteLanes) {
          auto cost = hn::LoadU(d8, costs + i);
          if (x + 1 < window.end) cost = with_border(row, x, window.begin + i, cost);
          hn::StoreU(cost, d8, memory + i);
        }
        costs += window.size();
        select<kVectors>(row, x, right_place(row, x), window, memory);
      }
    });
  }
  decide_right(row);
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(walk_pair);
HWY_EXPORT(select_by_cost);

namespace {

/// Bytes before and after the sums of a pixel, so that its candidates are copied as one word.
constexpr int kAround = Candidates::kSums;

/// The changes of the gray value between the columns of a row, and 0 at both ends.
void find_changes(const std::uint8_t* __restrict__ gray, int width,
                  std::uint8_t* __restrict__ changes) {
  changes[0] = changes[width] = 0;
  for (int x = 1; x < width; ++x) {
    changes[x] = std::max(gray[x], gray[x - 1]) - std::min(gray[x], gray[x - 1]);
  }
}

/// Starts the selection of a row.
RowSelection selection_of(const RowPair& pair, const PathRow& row, const SelectionOptions& options,
                          RowPairScratch& scratch) {
  Candidates& to = *row.candidates;
  std::memset(to.right.data(), 255, Candidates::kTurns * to.right_stride);
  const int lanes = cost_lanes(options.disparities);
  return {pair.width,
          lanes,
          options.runner_up_in_range ? row.low : nullptr,
          options.runner_up_in_range ? row.high : nullptr,
          scratch.limits.data(),
          scratch.beside.data() + lanes + 1,
          to.best.data(),
          to.sums.data(),
          to.right.data(),
          to.right_stride,
          lanes > 256};
}

}  // namespace

void RowPairScratch::resize(int width, int disparities) {
  const std::size_t lanes = cost_lanes(disparities);
  paths.resize(2 * width * lanes);
  changes.resize(2 * (width + 1));
  ends.resize(2 * lanes);
  sums.resize(2 * (lanes + 2 * kAround));
  limits.resize(3 * lanes);
  std::memset(limits.data(), 0, 3 * lanes);
  std::memset(limits.data() + lanes, 255, lanes);
  beside.resize(2 * lanes + 2);
  std::memset(beside.data(), 0, beside.size());
  std::memset(beside.data() + lanes, 255, 3);
}

std::uint8_t* RowPairScratch::sums_of(int row, int size) {
  std::uint8_t* first = sums.data() + kAround + row * (sums.size() / 2);
  first[-1] = first[size] = kNoSum;
  return first;
}

void match_row_pair(const RowPair& pair, const SelectionOptions& options, RowPairScratch& scratch) {
  RowSelection rows[2];
  for (int r = 0; r < 2; ++r) {
    find_changes(pair.rows[r].gray, pair.width, scratch.changes.data() + r * (pair.width + 1));
    rows[r] = selection_of(pair, pair.rows[r], options, scratch);
  }
  HWY_DYNAMIC_DISPATCH(walk_pair)(pair, rows, scratch);
}

void match_row_by_cost(const RowPair& pair, const SelectionOptions& options,
                       RowPairScratch& scratch) {
  const RowSelection row = selection_of(pair, pair.rows[0], options, scratch);
  HWY_DYNAMIC_DISPATCH(select_by_cost)(pair, row, scratch);
}

}  // namespace mtstereo
#endif  // HWY_ONCE
