// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/scanline_optimization.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "stages/census_cost.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "stages/scanline_optimization.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file once more for each processor.
#include <hwy/highway.h>

namespace mtstereo {
#ifndef MTSTEREO_SCANLINE_LAYOUT
#define MTSTEREO_SCANLINE_LAYOUT
/// What surrounds a pixel's path costs in ScanlineScratch::path: cells that no step comes from.
constexpr int kMargin = 64;
#endif
}  // namespace mtstereo

HWY_BEFORE_NAMESPACE();
namespace mtstereo {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Bytes = hn::CappedTag<std::uint8_t, 32>;

/// The least of all lanes in every lane.
template <class V>
V least_of_lanes(Bytes d8, V v) {
#if HWY_TARGET == HWY_SCALAR
  (void)d8;
  return v;
#else
  const hn::Repartition<std::uint16_t, Bytes> d16;
  const auto pairs = hn::BitCast(d16, v);
  const auto least =
      hn::MinOfLanes(d16, hn::Min(hn::And(pairs, hn::Set(d16, 0xFF)), hn::ShiftRight<8>(pairs)));
  return hn::BitCast(d8, hn::Or(least, hn::ShiftLeft<8>(least)));
#endif
}

/// One step of a path: the path costs `now` of a pixel from those of the pixel before, whose least
/// is `least_before` in every lane. Returns the least of the new ones.
template <class V>
V step_path(Bytes d8, const std::uint8_t* costs, const std::uint8_t* before, V least_before,
            V small_step, std::uint8_t large_step, int lanes, std::uint8_t* now) {
  const int step = static_cast<int>(hn::Lanes(d8));
  const V any = hn::SaturatedAdd(least_before, hn::Set(d8, large_step));
  V least = hn::Set(d8, 255);
  for (int d = 0; d < lanes; d += step) {
    const V same = hn::Load(d8, before + d);
    const V beside = hn::Min(hn::LoadU(d8, before + d - 1), hn::LoadU(d8, before + d + 1));
    const V best = hn::Min(hn::Min(same, hn::SaturatedAdd(beside, small_step)), any);
    const V path = hn::SaturatedAdd(hn::Load(d8, costs + d), hn::SaturatedSub(best, least_before));
    hn::Store(path, d8, now + d);
    least = hn::Min(least, path);
  }
  return least_of_lanes(d8, least);
}

void optimize(const std::uint8_t* costs, const std::uint8_t* gray, int width, int lanes,
              int small_step_cost, const LargeStepTable& large_step, ScanlineScratch& scratch,
              std::uint16_t* sums) {
  const Bytes d8;
  const hn::CappedTag<std::uint16_t, 16> d16;
  const hn::Rebind<std::uint8_t, decltype(d16)> d8_of_16;
  const int step16 = static_cast<int>(hn::Lanes(d16));
  const auto small_step = hn::Set(d8, static_cast<std::uint8_t>(std::min(small_step_cost, 255)));
  std::uint8_t* now = scratch.path.data() + kMargin;
  std::uint8_t* before = now + lanes + kMargin;

  std::memset(before, 0, lanes);  // no path yet: all alike
  auto least = hn::Zero(d8);
  for (int x = 0; x < width; ++x) {
    const std::uint8_t* cost = costs + static_cast<std::ptrdiff_t>(x) * lanes;
    const int change = x > 0 ? std::abs(gray[x] - gray[x - 1]) : 0;
    least = step_path(d8, cost, before, least, small_step, large_step[change], lanes, now);
    std::memcpy(scratch.forward.data() + static_cast<std::ptrdiff_t>(x) * lanes, now, lanes);
    std::swap(now, before);
  }
  std::memset(before, 0, lanes);
  least = hn::Zero(d8);
  for (int x = width - 1; x >= 0; --x) {
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(x) * lanes;
    const int change = x + 1 < width ? std::abs(gray[x] - gray[x + 1]) : 0;
    least = step_path(d8, costs + first, before, least, small_step, large_step[change], lanes, now);
    const std::uint8_t* forward = scratch.forward.data() + first;
    for (int d = 0; d < lanes; d += step16) {
      const auto from_left = hn::PromoteTo(d16, hn::Load(d8_of_16, forward + d));
      const auto from_right = hn::PromoteTo(d16, hn::Load(d8_of_16, now + d));
      hn::Store(hn::Add(from_left, from_right), d16, sums + first + d);
    }
    std::swap(now, before);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace mtstereo
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(optimize);

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
  forward.resize(width * lanes);
  path.resize(2 * lanes + 3 * kMargin);
  // The margins stay as they are; no step comes from there.
  std::memset(path.data(), 255, path.size());
}

void optimize_scanline(const std::uint8_t* costs, const std::uint8_t* gray, int width,
                       int disparities, int small_step, const LargeStepTable& large_step,
                       ScanlineScratch& scratch, std::uint16_t* sums) {
  HWY_DYNAMIC_DISPATCH(optimize)
  (costs, gray, width, cost_lanes(disparities), small_step, large_step, scratch, sums);
}

}  // namespace mtstereo
#endif  // HWY_ONCE
