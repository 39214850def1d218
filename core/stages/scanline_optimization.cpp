// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/scanline_optimization.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "stages/census_cost.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "stages/scanline_optimization.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file once more for each processor.
#include <hwy/highway.h>

namespace mtstereo {
#ifndef MTSTEREO_SCANLINE_ENDS
#define MTSTEREO_SCANLINE_ENDS
/// What surrounds a pixel's path costs in ScanlineScratch::ends: cells that no step comes from.
constexpr int kMargin = 64;

constexpr int kFromLeft = 0;
constexpr int kFromRight = 1;

/// Where a pixel's path costs stand in ScanlineScratch::ends.
inline std::uint8_t* path_end(ScanlineScratch& scratch, int lanes, int path, int which) {
  return scratch.ends.data() + kMargin + (2 * path + which) * (lanes + kMargin);
}
#endif
}  // namespace mtstereo

HWY_BEFORE_NAMESPACE();
namespace mtstereo {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Vectors of 64 bytes are worth it only on their own: most paths are rows of one or two of them.
using Narrow = hn::CappedTag<std::uint8_t, 32>;
using Wide = hn::CappedTag<std::uint8_t, 64>;

/// The least of all lanes in every lane.
template <class D8>
HWY_INLINE hn::Vec<D8> least_of_lanes(D8 d8, hn::Vec<D8> v) {
#if HWY_TARGET == HWY_SCALAR
  (void)d8;
  return v;
#else
  if constexpr (hn::MaxLanes(d8) > 16) {
    const hn::Half<D8> half;
    const auto least =
        least_of_lanes(half, hn::Min(hn::LowerHalf(half, v), hn::UpperHalf(half, v)));
    return hn::Combine(d8, least, least);
  } else {
    const hn::Repartition<std::uint16_t, D8> d16;
    const auto pairs = hn::BitCast(d16, v);
    const auto least =
        hn::MinOfLanes(d16, hn::Min(hn::And(pairs, hn::Set(d16, 0xFF)), hn::ShiftRight<8>(pairs)));
    return hn::BitCast(d8, hn::Or(least, hn::ShiftLeft<8>(least)));
  }
#endif
}

#if HWY_TARGET == HWY_SCALAR
/// Goes through a pixel's path costs, vector after vector, and tells those of the disparities
/// beside.
template <class D8>
class Neighborhood {
 public:
  using V = hn::Vec<D8>;
  Neighborhood(V before, V same) : before_(before), same_(same) {}
  V same() const { return same_; }
  /// The lesser of the lanes one before and of those one behind; `behind` is what comes next.
  V beside(V behind) const { return hn::Min(before_, behind); }
  void move_on(V behind) {
    before_ = same_;
    same_ = behind;
  }

 private:
  V before_, same_;
};
#else
/// Goes through a pixel's path costs, vector after vector, and tells those of the disparities
/// beside. Loads across what has just been stored would wait for it; so lanes are shifted.
template <class D8, bool kFourBlocks = (hn::MaxLanes(D8()) > 32)>
class Neighborhood {
 public:
  using V = hn::Vec<D8>;
  HWY_INLINE Neighborhood(V before, V same) : before_(before), same_(same) {}
  HWY_INLINE V same() const { return same_; }
  /// The lesser of the lanes one before and of those one behind; `behind` is what comes next.
  HWY_INLINE V beside(V behind) const {
    const D8 d8;
    if constexpr (hn::MaxLanes(d8) <= 16) {
      return hn::Min(hn::CombineShiftRightBytes<15>(d8, same_, before_),
                     hn::CombineShiftRightBytes<1>(d8, behind, same_));
    } else {
      // Blocks of 16 bytes are shifted on their own, next to the block before or behind.
      return hn::Min(
          hn::CombineShiftRightBytes<15>(d8, same_, hn::ConcatLowerUpper(d8, same_, before_)),
          hn::CombineShiftRightBytes<1>(d8, hn::ConcatLowerUpper(d8, behind, same_), same_));
    }
  }
  HWY_INLINE void move_on(V behind) {
    before_ = same_;
    same_ = behind;
  }

 private:
  V before_, same_;
};

#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL
/// The same for vectors of four blocks, each of which is turned by one block once in both ways.
template <class D8>
class Neighborhood<D8, true> {
 public:
  using V = hn::Vec<D8>;
  HWY_INLINE Neighborhood(V before, V same)
      : same_(same), up_before_(up(before)), up_same_(up(same)), down_same_(down(same)) {}
  HWY_INLINE V same() const { return same_; }
  HWY_INLINE V beside(V behind) const {
    const D8 d8;
    const auto before = hn::IfThenElse(hn::FirstN(d8, 16), up_before_, up_same_);
    const auto after = hn::IfThenElse(hn::FirstN(d8, 48), down_same_, down(behind));
    return hn::Min(hn::CombineShiftRightBytes<15>(d8, same_, before),
                   hn::CombineShiftRightBytes<1>(d8, after, same_));
  }
  HWY_INLINE void move_on(V behind) {
    same_ = behind;
    up_before_ = up_same_;
    up_same_ = up(behind);
    down_same_ = down(behind);
  }

 private:
  using Quads = hn::Repartition<std::uint32_t, D8>;
  static HWY_INLINE V turned(V v, const std::uint32_t* quads) {
    const Quads d32;
    return hn::BitCast(D8(),
                       hn::TableLookupLanes(hn::BitCast(d32, v), hn::SetTableIndices(d32, quads)));
  }
  static HWY_INLINE V up(V v) {
    alignas(64) static constexpr std::uint32_t kQuads[16] = {12, 13, 14, 15, 0, 1, 2,  3,
                                                             4,  5,  6,  7,  8, 9, 10, 11};
    return turned(v, kQuads);
  }
  static HWY_INLINE V down(V v) {
    alignas(64) static constexpr std::uint32_t kQuads[16] = {4,  5,  6,  7,  8, 9, 10, 11,
                                                             12, 13, 14, 15, 0, 1, 2,  3};
    return turned(v, kQuads);
  }
  V same_, up_before_, up_same_, down_same_;
};
#endif
#endif

/// A path on its way along the row: the costs of its last pixel and what they begin with.
template <class D8>
class Path {
 public:
  Path(const ScanlineRow& row, int lanes, int path, ScanlineScratch& scratch)
      : costs_(row.costs),
        gray_(row.gray),
        large_step_(row.large_step->data()),
        lanes_(lanes),
        back_(path == kFromLeft ? -1 : 1),
        small_step_(hn::Set(D8(), static_cast<std::uint8_t>(std::min(row.small_step, 255)))),
        least_(hn::Set(D8(), static_cast<std::uint8_t>(scratch.least[path]))),
        newest_(path_end(scratch, lanes, path, scratch.newest[path])),
        other_(path_end(scratch, lanes, path, 1 - scratch.newest[path])) {}

  /// The first pixel: no path leads there.
  void begin() {
    std::memset(newest_, 0, lanes_);
    least_ = hn::Zero(D8());
  }

  /// Goes on to column x, which comes next; `first` where it is the path's first.
  HWY_INLINE void step(int x, bool first) {
    const D8 d8;
    const int step = static_cast<int>(hn::Lanes(d8));
    const int change = first ? 0 : std::abs(gray_[x] - gray_[x + back_]);
    const auto any = hn::SaturatedAdd(least_, hn::Set(d8, large_step_[change]));
    const std::uint8_t* costs = costs_ + static_cast<std::ptrdiff_t>(x) * lanes_;
    auto least = hn::Set(d8, 255);
    // The margins stand for disparities that there are none of.
    Neighborhood<D8> last(hn::Load(d8, newest_ - step), hn::Load(d8, newest_));
    for (int d = 0; d < lanes_; d += step) {
      const auto behind = hn::Load(d8, newest_ + d + step);
      const auto beside = hn::SaturatedAdd(last.beside(behind), small_step_);
      const auto best = hn::Min(hn::Min(last.same(), beside), any);
      const auto path = hn::SaturatedAdd(hn::Load(d8, costs + d), hn::SaturatedSub(best, least_));
      hn::Store(path, d8, other_ + d);
      least = hn::Min(least, path);
      last.move_on(behind);
    }
    least_ = least_of_lanes(d8, least);
    std::swap(newest_, other_);
  }

  /// Keeps the last pixel's costs for the other path to find.
  HWY_INLINE void keep(std::uint8_t* paths, int x) const {
    const D8 d8;
    std::uint8_t* kept = paths + static_cast<std::ptrdiff_t>(x) * lanes_;
    for (int d = 0; d < lanes_; d += static_cast<int>(hn::Lanes(d8))) {
      hn::Store(hn::Load(d8, newest_ + d), d8, kept + d);
    }
  }

  /// Adds to the last pixel's costs those that the other path has kept there.
  HWY_INLINE void add(const std::uint8_t* paths, int x, std::uint16_t* sums) const {
    const hn::CappedTag<std::uint16_t, kCostStep> d16;
    const hn::Rebind<std::uint8_t, decltype(d16)> d8;
    const std::uint8_t* kept = paths + static_cast<std::ptrdiff_t>(x) * lanes_;
    for (int d = 0; d < lanes_; d += static_cast<int>(hn::Lanes(d16))) {
      const auto one = hn::PromoteTo(d16, hn::Load(d8, newest_ + d));
      const auto other = hn::PromoteTo(d16, hn::Load(d8, kept + d));
      hn::Store(hn::Add(one, other), d16, sums + d);
    }
  }

  /// Puts back what the next block begins with.
  void leave(int path, ScanlineScratch& scratch) const {
    scratch.least[path] = hn::GetLane(least_);
    scratch.newest[path] = newest_ == path_end(scratch, lanes_, path, 0) ? 0 : 1;
  }

 private:
  const std::uint8_t* costs_;
  const std::uint8_t* gray_;
  const std::uint8_t* large_step_;
  int lanes_;
  int back_;  // from a column to the one before
  hn::Vec<D8> small_step_;
  hn::Vec<D8> least_;  // of the last pixel's costs, in every lane
  std::uint8_t* newest_;
  std::uint8_t* other_;
};

/// Whether the row's pixels are whole wide vectors.
bool is_wide(const ScanlineRow& row) {
  const int wide = static_cast<int>(hn::MaxLanes(Wide()));
  return wide > static_cast<int>(hn::MaxLanes(Narrow())) && cost_lanes(row.disparities) % wide == 0;
}

/// Neighboring steps wait for each other; those of the two paths do not, so they take turns.
template <class D8>
void walk_to_middle_by(const ScanlineRow& row, ScanlineScratch& scratch) {
  const int lanes = cost_lanes(row.disparities);
  const int middle = row.width / 2;
  Path<D8> from_left(row, lanes, kFromLeft, scratch);
  Path<D8> from_right(row, lanes, kFromRight, scratch);
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

void walk_to_middle(const ScanlineRow& row, ScanlineScratch& scratch) {
  if (is_wide(row)) {
    walk_to_middle_by<Wide>(row, scratch);
  } else {
    walk_to_middle_by<Narrow>(row, scratch);
  }
}

/// Both paths over their blocks; that from the left goes begin .. end - 1, that from the right back
/// from right_end - 1.
template <class D8>
void walk_block_by(const ScanlineRow& row, int left_begin, int left_end, int right_begin,
                   int right_end, ScanlineScratch& scratch) {
  const int lanes = cost_lanes(row.disparities);
  Path<D8> from_left(row, lanes, kFromLeft, scratch);
  Path<D8> from_right(row, lanes, kFromRight, scratch);
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

void walk_block(const ScanlineRow& row, int left_begin, int left_end, int right_begin,
                int right_end, ScanlineScratch& scratch) {
  if (is_wide(row)) {
    walk_block_by<Wide>(row, left_begin, left_end, right_begin, right_end, scratch);
  } else {
    walk_block_by<Narrow>(row, left_begin, left_end, right_begin, right_end, scratch);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace mtstereo
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
  ends.resize(4 * (lanes + kMargin) + kMargin);
  // The margins stay as they are; no step comes from there.
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
