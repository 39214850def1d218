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

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

// Byte shifts work within blocks of 16 bytes. In vectors of two blocks one operation fetches the
// neighboring block; wider ones have none for that.
using Bytes = hn::CappedTag<std::uint8_t, 32>;

/// The least of all lanes, in every lane.
template <class V>
V least_of_lanes(Bytes d8, V v) {
#if HWY_TARGET == HWY_SSSE3
  // SSSE3 has no minimum of unsigned words.
  v = hn::Min(v, hn::ShiftRightBytes<8>(d8, v));
  v = hn::Min(v, hn::ShiftRightBytes<4>(d8, v));
  v = hn::Min(v, hn::ShiftRightBytes<2>(d8, v));
  v = hn::Min(v, hn::ShiftRightBytes<1>(d8, v));
  return hn::TableLookupBytes(v, hn::Zero(d8));
#else
  const hn::Repartition<std::uint16_t, Bytes> d16;
  const auto pairs = hn::BitCast(d16, v);
  const auto least =
      hn::MinOfLanes(d16, hn::Min(hn::And(pairs, hn::Set(d16, 0xFF)), hn::ShiftRight<8>(pairs)));
  return hn::BitCast(d8, hn::Or(least, hn::ShiftLeft<8>(least)));
#endif
}

/// The lanes of `v` moved up by one; the first is the last lane of `before`.
template <class V>
HWY_INLINE V lanes_before(Bytes d8, V v, V before) {
  if constexpr (hn::MaxLanes(d8) <= 16) {
    return hn::CombineShiftRightBytes<15>(d8, v, before);
  } else {
    return hn::CombineShiftRightBytes<15>(d8, v, hn::ConcatLowerUpper(d8, v, before));
  }
}

/// The lanes of `v` moved down by one; the last is the first lane of `after`.
template <class V>
HWY_INLINE V lanes_after(Bytes d8, V v, V after) {
  if constexpr (hn::MaxLanes(d8) <= 16) {
    return hn::CombineShiftRightBytes<1>(d8, after, v);
  } else {
    return hn::CombineShiftRightBytes<1>(d8, hn::ConcatLowerUpper(d8, after, v), v);
  }
}

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
      const auto adjacent = hn::Min(lanes_before(d8, same, before), lanes_after(d8, same, after));
      const auto best = hn::Min(hn::Min(same, hn::SaturatedAdd(adjacent, small_step_)), any);
      const auto path = hn::SaturatedAdd(hn::Load(d8, costs + d), hn::SaturatedSub(best, least_));
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
    const std::uint8_t* kept = paths + static_cast<std::ptrdiff_t>(x) * lanes_;
    const hn::CappedTag<std::uint16_t, kCostStep> d16;
    const hn::Rebind<std::uint8_t, decltype(d16)> d8;
    for (int d = 0; d < lanes_; d += static_cast<int>(hn::Lanes(d16))) {
      const auto one = hn::PromoteTo(d16, hn::Load(d8, newest_ + d));
      const auto other = hn::PromoteTo(d16, hn::Load(d8, kept + d));
      hn::Store(hn::Add(one, other), d16, sums + d);
    }
  }

  /// Saves the state for the next block.
  void leave(int path, ScanlineScratch& scratch) const {
    scratch.least[path] = hn::GetLane(least_);
    scratch.newest[path] = newest_ == path_end(scratch, lanes_, path, 0) ? 0 : 1;
  }

 private:
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
/// one backwards from right_end - 1 to right_begin.
void walk_block(const ScanlineRow& row, int left_begin, int left_end, int right_begin,
                int right_end, ScanlineScratch& scratch) {
  const int lanes = cost_lanes(row.disparities);
  Path from_left(row, lanes, kFromLeft, scratch);
  Path from_right(row, lanes, kFromRight, scratch);
  const std::uint8_t* paths = scratch.paths.data();
  std::uint16_t* left_sums = scratch.sums.data();
  std::uint16_t* right_sums = left_sums + kScanlineBlock * lanes;
  const int left_steps = left_end - left_begin;
  const int right_steps = right_end - right_begin;
  for (int i = 0; i < std::max(left_steps, right_steps); ++i) {
    if (i < left_steps) {
      const int x = left_begin + i;
      from_left.step(x, x == 0);
      from_left.add(paths, x, left_sums + i * lanes);
    }
    if (i < right_steps) {
      const int x = right_end - 1 - i;
      from_right.step(x, false);
      from_right.add(paths, x, right_sums + (x - right_begin) * lanes);
    }
  }
  from_left.leave(kFromLeft, scratch);
  from_right.leave(kFromRight, scratch);
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
