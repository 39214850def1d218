// SPDX-License-Identifier: LGPL-2.1-or-later
// Internal to row_walk.cpp and column_optimization.cpp: the costs of a path's pixel in
// vectors of bytes. Every SIMD target includes this header again, after base/simd.hpp.
#if defined(MTSTEREO_PATH_LANES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef MTSTEREO_PATH_LANES_INL_HPP
#undef MTSTEREO_PATH_LANES_INL_HPP
#else
#define MTSTEREO_PATH_LANES_INL_HPP
#endif

#include <cstdint>
#include <cstring>

#include "base/simd.hpp"
#include "stages/pixels/cost_lanes.hpp"
#include "stages/pixels/window_vectors-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

// Byte shifts work within blocks of 16 bytes. In vectors of two blocks one operation fetches the
// neighboring block; wider ones have none for that.
using Bytes = hn::CappedTag<std::uint8_t, 32>;

#if HWY_ARCH_X86 && HWY_TARGET <= HWY_SSE4
/// The least of all lanes, in the first one. Highway has no minimum of unsigned bytes. The
/// processors have one of eight unsigned words.
template <class V>
HWY_INLINE __m128i first_is_least(Bytes d8, V v) {
  __m128i least;
  if constexpr (hn::MaxLanes(d8) == 32) {
    const hn::Half<Bytes> half;
    least = hn::Min(hn::LowerHalf(half, v), hn::UpperHalf(half, v)).raw;
  } else {
    least = v.raw;
  }
  return _mm_minpos_epu16(_mm_min_epu8(least, _mm_srli_epi16(least, 8)));
}
#endif

/// The least of all lanes, in every lane.
template <class V>
HWY_INLINE V least_of_lanes(Bytes d8, V v) {
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_SSE4
  const auto least = first_is_least(d8, v);
  if constexpr (hn::MaxLanes(d8) == 32) {
    return V{_mm256_broadcastb_epi8(least)};
  } else {
    return hn::TableLookupBytes(V{least}, hn::Zero(d8));
  }
#elif HWY_ARCH_ARM_A64
  return hn::Set(d8, vminvq_u8(v.raw));
#else
  v = hn::Min(v, hn::ShiftRightBytes<8>(d8, v));
  v = hn::Min(v, hn::ShiftRightBytes<4>(d8, v));
  v = hn::Min(v, hn::ShiftRightBytes<2>(d8, v));
  v = hn::Min(v, hn::ShiftRightBytes<1>(d8, v));
  return hn::TableLookupBytes(v, hn::Zero(d8));
#endif
}

/// The least of all lanes.
template <class V>
HWY_INLINE std::uint8_t least_lane(Bytes d8, V v) {
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_SSE4
  return static_cast<std::uint8_t>(_mm_cvtsi128_si32(first_is_least(d8, v)));
#else
  return hn::GetLane(least_of_lanes(d8, v));
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

/// The path costs of a pixel: its costs plus the cheapest step from the path's previous pixel,
/// minus `least`, the least path cost there. `before`, `same` and `after` are successive vectors of
/// the previous pixel's path costs, `any` is `least` plus the cost of a large step.
template <class V>
HWY_INLINE V path_costs(Bytes d8, V costs, V before, V same, V after, V small_step, V any,
                        V least) {
  const auto adjacent = hn::Min(lanes_before(d8, same, before), lanes_after(d8, same, after));
  const auto best = hn::Min(hn::Min(same, hn::SaturatedAdd(adjacent, small_step)), any);
  return hn::SaturatedAdd(costs, hn::SaturatedSub(best, least));
}

/// The inputs of a path's step, in every lane: the cost of a small step, and the previous pixel's
/// least cost without and with a large step.
struct StepCosts {
  hn::Vec<Bytes> small_step, least, any;
};

/// Writes the path costs of a pixel in its window, and returns the least one. Steps come from the
/// previous pixel's costs in the same window. May overwrite them. kVectors: the number of the
/// window's vectors, or 0 if it is not known.
template <int kVectors>
HWY_INLINE std::uint8_t step_vectors(int size, const std::uint8_t* costs,
                                     const std::uint8_t* before, const StepCosts& steps,
                                     std::uint8_t* paths) {
  const Bytes d8;
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(Bytes()));
  const int vectors = kVectors > 0 ? kVectors : size / kLanes;
  const auto never = hn::Set(d8, 255);
  auto least = never;
  auto previous = never;
  auto same = hn::LoadU(d8, before);
  for (int i = 0; i < vectors; ++i) {
    // Loads whole vectors only: a load that spans two recent stores would wait for both.
    const auto after = i + 1 < vectors ? hn::LoadU(d8, before + (i + 1) * kLanes) : never;
    const auto path = path_costs(d8, hn::LoadU(d8, costs + i * kLanes), previous, same, after,
                                 steps.small_step, steps.any, steps.least);
    hn::StoreU(path, d8, paths + i * kLanes);
    least = i == 0 ? path : hn::Min(least, path);
    previous = same;
    same = after;
  }
  return least_lane(d8, least);
}

/// Between pixels of different windows: makes the costs of the pixel before never the least where
/// only the next pixel has disparities.
inline void extend_lanes(CostWindow before, CostWindow next, std::uint8_t* paths) {
  if (before == next) return;
  for (int d = next.begin; d < next.end; d += kWindowStep) {
    if (before.begin <= d && d < before.end) continue;
    std::memset(paths + d, 255, kWindowStep);
  }
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target
