// SPDX-License-Identifier: LGPL-2.1-or-later
// Internal to row_walk.cpp: the candidates of a pixel from its sums. Every SIMD target includes
// this header again, after base/simd.hpp.
#if defined(MTSTEREO_ROW_SELECTION_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef MTSTEREO_ROW_SELECTION_INL_HPP
#undef MTSTEREO_ROW_SELECTION_INL_HPP
#else
#define MTSTEREO_ROW_SELECTION_INL_HPP
#endif

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

#include "base/simd.hpp"
#include "base/simd_bits-inl.hpp"
#include "stages/pixels/path_lanes-inl.hpp"
#include "stages/pixels/row_selection.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

using ByteVector = hn::Vec<Bytes>;
constexpr int kByteLanes = static_cast<int>(hn::MaxLanes(Bytes()));

/// The vectors of a pixel: loaded from memory, or in it if their number is not known (0).
template <int kVectors>
class PixelLanes {
 public:
  PixelLanes() = default;
  HWY_INLINE PixelLanes(const std::uint8_t* memory, CostWindow) {
    for (int i = 0; i < kVectors; ++i) set(i, hn::LoadU(Bytes(), memory + i * kByteLanes));
  }
  HWY_INLINE static constexpr int count() { return kVectors; }
  HWY_INLINE ByteVector get(int i) const { return vectors_[i]; }
  HWY_INLINE void set(int i, ByteVector v) { vectors_[i] = v; }

 private:
  ByteVector vectors_[kVectors];
};

template <>
class PixelLanes<0> {
 public:
  PixelLanes() = default;
  PixelLanes(std::uint8_t* memory, CostWindow window)
      : memory_(memory), count_(vectors_of(Bytes(), window)) {}
  HWY_INLINE int count() const { return count_; }
  HWY_INLINE ByteVector get(int i) const { return hn::LoadU(Bytes(), memory_ + i * kByteLanes); }
  HWY_INLINE void set(int i, ByteVector v) { hn::StoreU(v, Bytes(), memory_ + i * kByteLanes); }

 private:
  std::uint8_t* memory_ = nullptr;
  int count_ = 0;
};

/// The first lane that is equal to `least`, which is one of them.
template <int kVectors>
HWY_INLINE int first_equal(const PixelLanes<kVectors>& lanes, ByteVector least) {
  const Bytes d8;
#if HWY_ARCH_ARM_A64
  for (int i = 0; i < lanes.count(); ++i) {
    const auto equal = hn::Eq(lanes.get(i), least);
    if (!hn::AllFalse(d8, equal)) {
      return i * kByteLanes + static_cast<int>(hn::FindKnownFirstTrue(d8, equal));
    }
  }
#else
  // The bits of several masks are compared together.
  constexpr int kTogether = 64 / kByteLanes;
  for (int i = 0; i < lanes.count(); i += kTogether) {
    std::uint64_t bits = 0;
    for (int k = 0; k < kTogether && i + k < lanes.count(); ++k) {
      bits |= bits_of(d8, hn::Eq(lanes.get(i + k), least)) << (k * kByteLanes);
    }
    const bool last = i + kTogether >= lanes.count();
    if (last || bits != 0) return i * kByteLanes + std::countr_zero(bits);
  }
#endif
  return 0;
}

/// What the selection of a row needs beside the sums.
enum class Selection { kPlain, kLimitedOrWide };

/// Each sum of a pixel from disparity d on replaces that of its right pixel, whose costs are at
/// `costs`, if it is less.
template <Selection kSelection>
HWY_INLINE void compete(const RowSelection& row, std::uint8_t* costs, int d, ByteVector sums) {
  const Bytes d8;
  const std::ptrdiff_t plane = Candidates::kTurns * row.right_stride;
  const auto before = hn::LoadU(d8, costs);
  const auto least = hn::Min(before, sums);
  const auto stays = hn::Eq(least, before);
  hn::StoreU(least, d8, costs);
  const auto lanes = hn::Iota(d8, 0);
  const auto low = hn::Add(lanes, hn::Set(d8, static_cast<std::uint8_t>(d)));
  std::uint8_t* lows = costs + Candidates::kLow * plane;
  hn::StoreU(hn::IfThenElse(stays, hn::LoadU(d8, lows), low), d8, lows);
  if (kSelection == Selection::kPlain || !row.high_planes) return;
  std::uint8_t* highs = costs + Candidates::kHigh * plane;
  const auto carry = hn::IfThenElseZero(hn::Lt(low, lanes), hn::Set(d8, 1));
  const auto high = hn::Add(hn::Set(d8, static_cast<std::uint8_t>(d >> 8)), carry);
  hn::StoreU(hn::IfThenElse(stays, hn::LoadU(d8, highs), high), d8, highs);
}

/// Sets those of the sums that cannot be runner-up to 255. `best` and d count from the window's
/// first disparity, `begin`.
template <Selection kSelection>
HWY_INLINE ByteVector without(const RowSelection& row, int x, int begin, int best, int d,
                              ByteVector sums) {
  const Bytes d8;
  const auto others = hn::Or(sums, hn::LoadU(d8, row.beside - best + d));
  if (kSelection == Selection::kPlain || row.low == nullptr) return others;
  const std::uint8_t* below = row.limits + 2 * row.lanes - row.low[x] + begin;
  const std::uint8_t* above = row.limits + row.lanes - 1 - row.high[x] + begin;
  return hn::Or(others, hn::Or(hn::LoadU(d8, below + d), hn::LoadU(d8, above + d)));
}

/// Lets disparities without a right pixel cost 255: those above x.
HWY_INLINE void hide_border(const RowSelection& row, int x0, int x1, CostWindow window,
                            std::uint8_t* sums) {
  const Bytes d8;
  for (int x = x0; x < std::min<int>(x1, window.end - 1); ++x, sums += kByteLanes) {
    const std::uint8_t* hidden = row.limits + row.lanes - 1 - x + window.begin;
    for (int i = 0; i < window.size(); i += kByteLanes, sums += kByteLanes) {
      hn::StoreU(hn::Max(hn::LoadU(d8, sums), hn::LoadU(d8, hidden + i)), d8, sums);
    }
  }
}

/// Finds the candidates of the columns x0 .. x1 - 1 of a tile from their sums, as
/// RowWalkScratch::sums_of() has them.
template <Selection kSelection, int kVectors>
HWY_NOINLINE void select_pixels(const RowSelection& of_row, int x0, int x1, CostWindow window,
                                std::uint8_t* memory) {
  static_assert(Candidates::kTurns == 2);
  const Bytes d8;
  // A copy: the compiler knows that no store of bytes changes it.
  const RowSelection row = of_row;
  // The places of this column's first right pixel and of the next one's.
  const std::ptrdiff_t turn = x0 % Candidates::kTurns * row.right_stride;
  std::ptrdiff_t place = turn + (row.width - 1 - x0) + window.begin;
  std::ptrdiff_t next = place - 1 + row.right_stride - 2 * turn;
  for (int x = x0; x < x1; ++x) {
    const PixelLanes<kVectors> sums(memory, window);
    auto least = sums.get(0);
    for (int i = 0; i < sums.count(); ++i) {
      if (i > 0) least = hn::Min(least, sums.get(i));
      const int d = i * kByteLanes;
      compete<kSelection>(row, row.right + place + d, window.begin + d, sums.get(i));
    }
    const int best = first_equal(sums, least_of_lanes(d8, least));
    const auto other = [&](int i) HWY_ATTR {
      return without<kSelection>(row, x, window.begin, best, i * kByteLanes, sums.get(i));
    };
    auto second = other(0);
    for (int i = 1; i < sums.count(); ++i) second = hn::Min(second, other(i));
    row.best[x] = static_cast<std::int16_t>(window.begin + best);
    std::uint8_t* found = row.sums + std::ptrdiff_t{Candidates::kSums} * x;
    std::memcpy(found, memory + best - 1, Candidates::kSums);
    found[Candidates::kSecond] = least_lane(d8, second);
    memory += (sums.count() + 1) * kByteLanes;
    place = std::exchange(next, place - Candidates::kTurns);
  }
}

/// The same, after sums of disparities without a right pixel are hidden.
template <int kVectors>
HWY_INLINE void select_tile(const RowSelection& row, int x0, int x1, CostWindow window,
                            std::uint8_t* memory) {
  hide_border(row, x0, x1, window, memory);
  if (row.low == nullptr && !row.high_planes) {
    select_pixels<Selection::kPlain, kVectors>(row, x0, x1, window, memory);
  } else {
    select_pixels<Selection::kLimitedOrWide, kVectors>(row, x0, x1, window, memory);
  }
}

/// Decides between the turns: writes the disparities of all right pixels to those of the first.
HWY_INLINE void decide_right(const RowSelection& row) {
  const Bytes d8;
  const std::ptrdiff_t turn = row.right_stride, plane = Candidates::kTurns * turn;
  for (int x = 0; x < row.width; x += kByteLanes) {
    // The planes in the order in which they decide.
    auto less = hn::FirstN(d8, 0), equal = hn::FirstN(d8, kByteLanes);
    for (int p = 0; p < Candidates::kPlanes; ++p) {
      if (p == Candidates::kHigh && !row.high_planes) continue;
      const auto first = hn::LoadU(d8, row.right + p * plane + x);
      const auto second = hn::LoadU(d8, row.right + p * plane + turn + x);
      less = hn::Or(less, hn::And(equal, hn::Lt(second, first)));
      equal = hn::And(equal, hn::Eq(second, first));
    }
    for (const int p : {Candidates::kHigh, Candidates::kLow}) {
      std::uint8_t* first = row.right + p * plane + x;
      hn::StoreU(hn::IfThenElse(less, hn::LoadU(d8, first + turn), hn::LoadU(d8, first)), d8,
                 first);
    }
  }
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target
