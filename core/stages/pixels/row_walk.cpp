// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixels/row_walk.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <type_traits>
#include <utility>

#include "stages/pixels/row_selection.hpp"

namespace mtstereo {

/// Those of rows that are walked along together.
using RowSelections = std::array<RowSelection, kWalkedRows>;

}  // namespace mtstereo

#define HWY_TARGET_INCLUDE "stages/pixels/row_walk.cpp"
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

/// Calls body(r) for the rows 0 .. kRows - 1. As r is a constant each time, compilers keep the
/// elements of arrays in registers.
template <int kRows, class Body>
HWY_INLINE void for_rows(const Body& body) {
  [&]<int... kRow>(std::integer_sequence<int, kRow...>) HWY_ATTR {
    (body(std::integral_constant<int, kRow>()), ...);
  }
  (std::make_integer_sequence<int, kRows>());
}

/// One direction of the walk along the rows.
template <PathSums kSums, bool kSelect>
class RowWalk {
 public:
  RowWalk(const WalkedRows& walked, const RowSelections& rows, RowWalkScratch& scratch)
      : walked_(walked),
        rows_(rows),
        lanes_(rows[0].lanes),
        paths_(scratch.paths.data()),
        large_steps_(scratch.large_steps.data()),
        ends_(scratch.ends.data()),
        scratch_(scratch),
        small_step_(hn::Set(
            Bytes(), static_cast<std::uint8_t>(std::min(walked.smoothness.small_step, 255)))) {}

  HWY_INLINE void run() {
    const int tiles = (walked_.width + kWindowTile - 1) / kWindowTile;
    std::memset(ends_, 0, kWalkedRows * lanes_);
    for (ByteVector& least : least_) least = hn::Zero(Bytes());
    CostWindow before = {0, static_cast<std::uint16_t>(lanes_)};
    // The cell after those of the last tile.
    std::ptrdiff_t cell = kSelect ? 0 : row_cells(walked_.windows, lanes_, walked_.width);
    for (int i = 0; i < tiles; ++i) {
      const int x0 = (kSelect ? i : tiles - 1 - i) * kWindowTile;
      const CostWindow window = window_at(walked_.windows, lanes_, x0);
      for (int r = 0; r < kWalkedRows && i > 0; ++r) {
        extend_lanes(before, window, ends_ + r * lanes_);
      }
      before = window;
      if constexpr (!kSelect) cell -= pixels_at(x0) * std::ptrdiff_t{window.size()};
      with_vectors<Bytes>(window, [&]<int kVectors>(std::integral_constant<int, kVectors>)
                                      HWY_ATTR { walk_tile<kVectors>(x0, window, cell); });
      if constexpr (kSelect) cell += pixels_at(x0) * std::ptrdiff_t{window.size()};
    }
  }

 private:
  int pixels_at(int x0) const { return std::min(kWindowTile, walked_.width - x0); }

  /// Advances the paths in a tile, whose cells begin at `cell`. Each step of a path waits for the
  /// one before it; those of other rows fill the time.
  template <int kVectors>
  HWY_INLINE void walk_tile(int x0, CostWindow window, std::ptrdiff_t cell) {
    constexpr int kRows = kVectors == 1 ? kWalkedRows : 2;
    for (int r = 0; r < kWalkedRows; r += kRows) walk_rows<kVectors, kRows>(r, x0, window, cell);
  }

  /// Advances those of the rows first .. first + kRows - 1.
  template <int kVectors, int kRows>
  HWY_INLINE void walk_rows(int first, int x0, CostWindow window, std::ptrdiff_t cell) {
    using Lanes = PixelLanes<kVectors>;
    std::uint8_t* const ends = ends_ + first * lanes_ + window.begin;
    const std::ptrdiff_t row_bytes = walked_.width * std::ptrdiff_t{lanes_};
    std::uint8_t* const from_right = paths_ + first * row_bytes;
    const std::uint8_t* large_steps[kRows];
    Lanes paths[kRows];
    ByteVector least[kRows];
    for_rows<kRows>([&](auto r) HWY_ATTR {
      large_steps[r] = large_steps_ + (first + r) * (walked_.width + 1) + !kSelect;
      paths[r] = Lanes(ends + r * lanes_, window);
      least[r] = least_[first + r];
    });
    const int pixels = pixels_at(x0);
    const std::ptrdiff_t size = paths[0].count() * kByteLanes;
    std::uint8_t* sums = scratch_.sums_of(first);
    const std::ptrdiff_t sums_stride = scratch_.sums_stride;
    if constexpr (!kSelect) cell += pixels * size;
    for (int i = 0; i < pixels; ++i) {
      const std::ptrdiff_t x = kSelect ? x0 + i : x0 + pixels - 1 - i;
      if constexpr (!kSelect) cell -= size;
      for_rows<kRows>([&](auto r) HWY_ATTR {
        const StepCosts steps = {small_step_, least[r],
                                 hn::SaturatedAdd(least[r], hn::Set(Bytes(), large_steps[r][x]))};
        least[r] = advance(walked_.of[first + r].costs + cell, steps, paths[r]);
        if constexpr (kSelect) {
          add_up(first + r, cell, paths[r], from_right + r * row_bytes + cell,
                 sums + r * sums_stride);
        } else {
          store(paths[r], from_right + r * row_bytes + cell);
        }
      });
      if constexpr (!kSelect) continue;
      cell += size;
      sums += size + kByteLanes;
    }
    for_rows<kRows>([&](auto r) HWY_ATTR {
      if constexpr (kSelect) {
        select_tile<kVectors>(rows_[first + r], x0, x0 + pixels, window,
                              scratch_.sums_of(first + r));
      }
      store(paths[r], ends + r * lanes_);
      least_[first + r] = least[r];
    });
  }

  /// Writes the sums of a pixel's path costs, and the vector of kNoSum after them.
  template <int kVectors>
  HWY_INLINE void add_up(int r, std::ptrdiff_t cell, const PixelLanes<kVectors>& path,
                         const std::uint8_t* from_right, std::uint8_t* sums) {
    const Bytes d8;
    for (int i = 0; i < path.count(); ++i) {
      const int d = i * kByteLanes;
      auto sum = hn::AverageRound(path.get(i), hn::LoadU(d8, from_right + d));
      if constexpr (kSums == PathSums::kFour) {
        const auto above = hn::LoadU(d8, walked_.of[r].from_above + cell + d);
        const auto below = hn::LoadU(d8, walked_.of[r].from_below + cell + d);
        sum = hn::AverageRound(sum, hn::AverageRound(above, below));
      }
      hn::StoreU(sum, d8, sums + d);
    }
    hn::StoreU(hn::Set(d8, kNoSum), d8, sums + path.count() * kByteLanes);
  }

  template <int kVectors>
  HWY_INLINE static void store(const PixelLanes<kVectors>& lanes, std::uint8_t* to) {
    for (int i = 0; i < lanes.count(); ++i) {
      hn::StoreU(lanes.get(i), Bytes(), to + i * kByteLanes);
    }
  }

  // Copies: the compiler knows that no store of bytes changes them.
  const WalkedRows walked_;
  const RowSelections rows_;
  const int lanes_;
  std::uint8_t* const paths_;
  const std::uint8_t* const large_steps_;
  std::uint8_t* const ends_;
  RowWalkScratch& scratch_;
  const ByteVector small_step_;
  ByteVector least_[kWalkedRows];
};

template <PathSums kSums>
void walk_both_ways(const WalkedRows& walked, const RowSelections& rows, RowWalkScratch& scratch) {
  RowWalk<kSums, false>(walked, rows, scratch).run();
  RowWalk<kSums, true>(walked, rows, scratch).run();
}

void walk_rows(const WalkedRows& walked, const RowSelections& rows, RowWalkScratch& scratch) {
  switch (walked.sums) {
    case PathSums::kTwo:
      walk_both_ways<PathSums::kTwo>(walked, rows, scratch);
      break;
    case PathSums::kFour:
      walk_both_ways<PathSums::kFour>(walked, rows, scratch);
      break;
  }
  for (const RowSelection& row : rows) decide_right(row);
}

/// Selects by the costs of a row.
void select_by_cost(const WalkedRows& walked, const std::uint8_t* costs, const RowSelection& of_row,
                    RowWalkScratch& scratch) {
  const RowSelection row = of_row;
  const Bytes d8;
  for (int x0 = 0; x0 < row.width; x0 += kWindowTile) {
    const CostWindow window = window_at(walked.windows, row.lanes, x0);
    const int x1 = std::min(x0 + kWindowTile, row.width);
    std::uint8_t* sums = scratch.sums_of(0);
    for (int x = x0; x < x1; ++x, sums += kByteLanes) {
      for (int i = 0; i < window.size(); i += kByteLanes) {
        hn::StoreU(hn::LoadU(d8, costs), d8, sums);
        costs += kByteLanes;
        sums += kByteLanes;
      }
      hn::StoreU(hn::Set(d8, kNoSum), d8, sums);
    }
    with_vectors<Bytes>(window, [&]<int kVectors>(std::integral_constant<int, kVectors>) HWY_ATTR {
      select_tile<kVectors>(row, x0, x1, window, scratch.sums_of(0));
    });
  }
  decide_right(row);
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(walk_rows);
HWY_EXPORT(select_by_cost);

namespace {

/// The large steps between the columns of a row. Those at its ends do not matter: there is no path
/// before.
void find_row_steps(const SmoothnessOptions& options, const std::uint8_t* gray, int width,
                    std::uint8_t* large_steps) {
  large_steps[0] = large_steps[width] = 0;
  find_large_steps(options, gray + 1, gray, width - 1, large_steps + 1);
}

/// Starts the selection of a row.
RowSelection selection_of(const WalkedRows& walked, const PathRow& row,
                          const SelectionOptions& options, RowWalkScratch& scratch) {
  Candidates& to = *row.candidates;
  std::memset(to.right.data(), 255, Candidates::kTurns * to.right_stride);
  const int lanes = cost_lanes(options.disparities);
  return {walked.width,
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

void RowWalkScratch::resize(int width, int disparities) {
  const std::size_t lanes = cost_lanes(disparities);
  paths.resize(kWalkedRows * width * lanes);
  large_steps.resize(kWalkedRows * (width + 1));
  ends.resize(kWalkedRows * lanes);
  sums_stride = kWindowTile * (lanes + kCostStep) + kCostStep;
  sums.resize(kWalkedRows * sums_stride);
  for (int r = 0; r < kWalkedRows; ++r) std::memset(sums_of(r) - kCostStep, kNoSum, kCostStep);
  limits.resize(3 * lanes);
  std::memset(limits.data(), 0, 3 * lanes);
  std::memset(limits.data() + lanes, 255, lanes);
  beside.resize(2 * lanes + 2);
  std::memset(beside.data(), 0, beside.size());
  std::memset(beside.data() + lanes, 255, 3);
}

void match_walked_rows(const WalkedRows& walked, const SelectionOptions& options,
                       RowWalkScratch& scratch) {
  RowSelections rows;
  for (int r = 0; r < kWalkedRows; ++r) {
    find_row_steps(walked.smoothness, walked.of[r].gray, walked.width,
                   scratch.large_steps.data() + r * (walked.width + 1));
    rows[r] = selection_of(walked, walked.of[r], options, scratch);
  }
  HWY_DYNAMIC_DISPATCH(walk_rows)(walked, rows, scratch);
}

void match_row_by_cost(const WalkedRows& walked, int row, const SelectionOptions& options,
                       RowWalkScratch& scratch) {
  HWY_DYNAMIC_DISPATCH(select_by_cost)
  (walked, walked.of[row].costs, selection_of(walked, walked.of[row], options, scratch), scratch);
}

}  // namespace mtstereo
#endif  // HWY_ONCE
