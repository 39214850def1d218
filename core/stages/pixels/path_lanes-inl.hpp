// SPDX-License-Identifier: LGPL-2.1-or-later
// Internal to scanline_optimization.cpp and column_optimization.cpp: the costs of a path's pixel in
// vectors of bytes. Every SIMD target includes this header again, after base/simd.hpp.
#if defined(MTSTEREO_PATH_LANES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef MTSTEREO_PATH_LANES_INL_HPP
#undef MTSTEREO_PATH_LANES_INL_HPP
#else
#define MTSTEREO_PATH_LANES_INL_HPP
#endif

#include <cstdint>

#include "base/simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

// Byte shifts work within blocks of 16 bytes. In vectors of two blocks one operation fetches the
// neighboring block; wider ones have none for that.
using Bytes = hn::CappedTag<std::uint8_t, 32>;

/// The least of all lanes, in every lane.
template <class V>
HWY_INLINE V least_of_lanes(Bytes d8, V v) {
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

/// The path costs of a pixel: its costs plus those of the cheapest step from the path's previous
/// pixel, minus `least`, the least path cost there. `before`, `same` and `after` are successive
/// vectors of the previous pixel's path costs, `any` is `least` plus the cost of a large step.
template <class V>
HWY_INLINE V path_costs(Bytes d8, V costs, V before, V same, V after, V small_step, V any,
                        V least) {
  const auto adjacent = hn::Min(lanes_before(d8, same, before), lanes_after(d8, same, after));
  const auto best = hn::Min(hn::Min(same, hn::SaturatedAdd(adjacent, small_step)), any);
  return hn::SaturatedAdd(costs, hn::SaturatedSub(best, least));
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target
