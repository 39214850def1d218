// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixels/scanline_optimization.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "stages/pixels/census_cost.hpp"
#include "stages/pixels/scanline_ends.hpp"

#define HWY_TARGET_INCLUDE "stages/pixels/scanline_optimization.cpp"
#include "base/simd.hpp"
#include "stages/pixels/path_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

/// The state of one path along the row: the costs of its last pixel and the inputs of the next
/// step.
class Path {
 public:
  Path(const ScanlineRow& row, int lanes, int path, ScanlineScratch& scratch)
      : costs_(row.costs),
        gray_(row.gray),
        large_step_(row.large_step->data()),
        lanes_(lanes),
        back_(path == kFromLeft ? -1 : 1),
        small_step_(hn::Set(Bytes(), static_cast<std::uint8_t>(std::min(row.small_step, 255)))),
        least_(hn::Set(Bytes(), static_cast<std::uint8_t>(scratch.least[path]))),
        newest_(path_end(scratch, lanes, path, scratch.newest[path])),
        other_(path_end(scratch, lanes, path, 1 - scratch.newest[path])) {}

  /// Starts at the path's first pixel, which has no predecessor.
  void begin() {
    std::memset(newest_, 0, lanes_);
    least_ = hn::Zero(Bytes());
  }

  /// Advances to column x, the next one; `first` for the path's first pixel.
  HWY_INLINE void step(int x, bool first) {
    const Bytes d8;
    const int step = static_cast<int>(hn::Lanes(d8));
    const int change = first ? 0 : std::abs(gray_[x] - gray_[x + back_]);
    const auto any = hn::SaturatedAdd(least_, hn::Set(d8, large_step_[change]));
    const std::uint8_t* costs = costs_ + static_cast<std::ptrdiff_t>(x) * lanes_;
    auto least = hn::Set(d8, 255);
    // Loads whole vectors only: a load that spans two recent stores would wait for both.
    auto before = hn::Load(d8, newest_ - step);
    auto same = hn::Load(d8, newest_);
    for (int d = 0; d < lanes_; d += step) {
      const auto after = hn::Load(d8, newest_ + d + step);
      const auto path =
          path_costs(d8, hn::Load(d8, costs + d), before, same, after, small_step_, any, least_);
      hn::Store(path, d8, other_ + d);
      least = hn::Min(least, path);
      before = same;
      same = after;
    }
    least_ = least_of_lanes(d8, least);
    std::swap(newest_, other_);
  }

  /// Stores the last pixel's costs for the other path.
  HWY_INLINE void keep(std::uint8_t* paths, int x) const {
    std::uint8_t* kept = paths + static_cast<std::ptrdiff_t>(x) * lanes_;
    const Bytes d8;
    for (int d = 0; d < lanes_; d += static_cast<int>(hn::Lanes(d8))) {
      hn::Store(hn::Load(d8, newest_ + d), d8, kept + d);
    }
  }

  /// Writes the sums of the last pixel's costs and of those that the other path has stored for it.
  HWY_INLINE void add(const std::uint8_t* paths, int x, std::uint16_t* sums) const {
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(x) * lanes_;
    for (int d = 0; d < lanes_; d += static_cast<int>(hn::Lanes(Sums()))) {
      hn::Store(sum(paths + first, d), Sums(), sums + d);
    }
  }

  /// The same with the paths along the columns: half the sums of all four.
  HWY_INLINE void add_columns(const std::uint8_t* paths, const ColumnCosts& columns, int x,
                              std::uint16_t* sums) const {
    const hn::Rebind<std::uint8_t, Sums> d8;
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(x) * lanes_;
    for (int d = 0; d < lanes_; d += static_cast<int>(hn::Lanes(Sums()))) {
      const auto above = hn::PromoteTo(Sums(), hn::Load(d8, columns.from_above + first + d));
      const auto below = hn::PromoteTo(Sums(), hn::Load(d8, columns.from_below + first + d));
      const auto all = hn::Add(sum(paths + first, d), hn::Add(above, below));
      hn::Store(hn::ShiftRight<1>(all), Sums(), sums + d);
    }
  }

  /// Saves the state for the next block.
  void leave(int path, ScanlineScratch& scratch) const {
    scratch.least[path] = hn::GetLane(least_);
    scratch.newest[path] = newest_ == path_end(scratch, lanes_, path, 0) ? 0 : 1;
  }

 private:
  using Sums = hn::CappedTag<std::uint16_t, kCostStep>;

  HWY_INLINE hn::Vec<Sums> sum(const std::uint8_t* kept, int d) const {
    const hn::Rebind<std::uint8_t, Sums> d8;
    return hn::Add(hn::PromoteTo(Sums(), hn::Load(d8, newest_ + d)),
                   hn::PromoteTo(Sums(), hn::Load(d8, kept + d)));
  }

  const std::uint8_t* costs_;
  const std::uint8_t* gray_;
  const std::uint8_t* large_step_;
  int lanes_;
  int back_;  // offset from a column to the path's previous one
  hn::Vec<Bytes> small_step_;
  hn::Vec<Bytes> least_;  // of the last pixel's costs, in every lane
  std::uint8_t* newest_;
  std::uint8_t* other_;
};

/// Each step of a path depends on the previous one, but the two paths are independent. So their
/// steps alternate.
void walk_to_middle(const ScanlineRow& row, ScanlineScratch& scratch) {
  const int lanes = cost_lanes(row.disparities);
  const int middle = row.width / 2;
  Path from_left(row, lanes, kFromLeft, scratch);
  Path from_right(row, lanes, kFromRight, scratch);
  from_left.begin();
  from_right.begin();
  std::uint8_t* paths = scratch.paths.data();
  for (int i = 0; i < middle; ++i) {
    const int x = row.width - 1 - i;
    from_left.step(i, i == 0);
    from_left.keep(paths, i);
    from_right.step(x, i == 0);
    from_right.keep(paths, x);
  }
  if (row.width % 2 != 0) {
    from_right.step(middle, middle == 0);
    from_right.keep(paths, middle);
  }
  from_left.leave(kFromLeft, scratch);
  from_right.leave(kFromRight, scratch);
}

/// Advances both paths over their blocks: the left one over left_begin .. left_end - 1, the right
/// one backwards from right_end - 1 to right_begin. `add` writes the sums of a path's column.
template <class Add>
HWY_INLINE void walk(const ScanlineRow& row, int left_begin, int left_end, int right_begin,
                     int right_end, const Add& add, ScanlineScratch& scratch) {
  const int lanes = cost_lanes(row.disparities);
  Path from_left(row, lanes, kFromLeft, scratch);
  Path from_right(row, lanes, kFromRight, scratch);
  std::uint16_t* left_sums = scratch.sums.data();
  std::uint16_t* right_sums = left_sums + kScanlineBlock * lanes;
  const int left_steps = left_end - left_begin;
  const int right_steps = right_end - right_begin;
  for (int i = 0; i < std::max(left_steps, right_steps); ++i) {
    if (i < left_steps) {
      const int x = left_begin + i;
      from_left.step(x, x == 0);
      add(from_left, x, left_sums + i * lanes);
    }
    if (i < right_steps) {
      const int x = right_end - 1 - i;
      from_right.step(x, false);
      add(from_right, x, right_sums + (x - right_begin) * lanes);
    }
  }
  from_left.leave(kFromLeft, scratch);
  from_right.leave(kFromRight, scratch);
}

void walk_block(const ScanlineRow& row, int left_begin, int left_end, int right_begin,
                int right_end, ScanlineScratch& scratch) {
  const std::uint8_t* paths = scratch.paths.data();
  if (row.columns.from_above == nullptr) {
    const auto add = [&](const Path& path, int x, std::uint16_t* sums) {
      path.add(paths, x, sums);
    };
    walk(row, left_begin, left_end, right_begin, right_end, add, scratch);
  } else {
    const auto add = [&](const Path& path, int x, std::uint16_t* sums) {
      path.add_columns(paths, row.columns, x, sums);
    };
    walk(row, left_begin, left_end, right_begin, right_end, add, scratch);
  }
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(walk_to_middle);
HWY_EXPORT(walk_block);

LargeStepTable large_step_table(const SmoothnessOptions& options) {
  LargeStepTable table{};
  for (int change = 0; change < 256; ++change) {
    const int cost = std::max(options.large_step * 8 / (8 + change), options.small_step);
    table[change] = static_cast<std::uint8_t>(std::min(options.large_step == 0 ? 0 : cost, 255));
  }
  return table;
}

void ScanlineScratch::resize(int width, int disparities) {
  const std::size_t lanes = cost_lanes(disparities);
  paths.resize(width * lanes);
  sums.resize(2 * kScanlineBlock * lanes);
  ends.resize(4 * (lanes + kEndMargin) + kEndMargin);
  // The margins keep this value, so that no step comes from there.
  std::memset(ends.data(), 255, ends.size());
}

int scanline_blocks(int width) { return (width - width / 2 + kScanlineBlock - 1) / kScanlineBlock; }

void start_scanline(const ScanlineRow& row, ScanlineScratch& scratch) {
  HWY_DYNAMIC_DISPATCH(walk_to_middle)(row, scratch);
}

std::array<ScanlineSums, 2> scanline_block(const ScanlineRow& row, int block,
                                           ScanlineScratch& scratch) {
  const int middle = row.width / 2;
  const int left_begin = middle + block * kScanlineBlock;
  const int left_end = std::min(left_begin + kScanlineBlock, row.width);
  const int right_end = std::max(middle - block * kScanlineBlock, 0);
  const int right_begin = std::max(right_end - kScanlineBlock, 0);
  HWY_DYNAMIC_DISPATCH(walk_block)(row, left_begin, left_end, right_begin, right_end, scratch);
  const std::uint16_t* sums = scratch.sums.data();
  return {
      ScanlineSums{left_begin, left_end, sums},
      ScanlineSums{right_begin, right_end, sums + kScanlineBlock * cost_lanes(row.disparities)}};
}

}  // namespace mtstereo
#endif  // HWY_ONCE
