// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/guide_clue.hpp"

#include <algorithm>
#include <cstring>

#include "stages/refine/reliability_table.hpp"

#define HWY_TARGET_INCLUDE "stages/refine/guide_clue.cpp"
#include "base/simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

/// Writes what `width` pixels of the guide say; each is two of the row.
void spread(const std::int32_t* disparity, const std::uint8_t* confidence, int width,
            std::int32_t* expected, std::uint8_t* bins) {
  const hn::CappedTag<std::int32_t, kAlignment / 4> d32;
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(d32))) {
    const auto twice = hn::ShiftLeft<1>(hn::LoadU(d32, disparity + x));
    hn::StoreInterleaved2(twice, twice, d32, expected + std::ptrdiff_t{2} * x);
  }
  const hn::CappedTag<std::uint8_t, kAlignment> d8;
  const auto first = hn::Set(d8, kLeastGuideConfidence - 1);
  const auto level = hn::Set(d8, kGuideLevel), one = hn::Set(d8, 1);
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(d8))) {
    auto rest = hn::SaturatedSub(hn::LoadU(d8, confidence + x), first);
    auto levels = hn::Zero(d8);
    for (int i = 1; i < kGuideLevels; ++i) {
      rest = hn::SaturatedSub(rest, level);
      levels = hn::Add(levels, hn::Min(rest, one));
    }
    static_assert(kGuideDistances == 1 << 2);
    const auto bin = hn::Add(hn::Add(levels, levels), hn::Add(levels, levels));
    hn::StoreInterleaved2(bin, bin, d8, bins + std::ptrdiff_t{2} * x);
  }
}

/// Adds the number of ends up to the distance; a loop that compilers vectorize.
void add_distances(const std::int32_t* __restrict__ map, const std::int32_t* __restrict__ expected,
                   int width, std::uint8_t* __restrict__ bins) {
  for (int x = 0; x < width; ++x) {
    const std::int32_t distance =
        map[x] > expected[x] ? map[x] - expected[x] : expected[x] - map[x];
    int ends = 0;
    for (const int end : kGuideDistanceEnds) ends += distance >= end;
    bins[x] = static_cast<std::uint8_t>(bins[x] + ends);
  }
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(spread);
HWY_EXPORT(add_distances);

static_assert(kGuideLevels * kGuideDistances == kClueBins);

void find_guide_bins(const RatedGuide& guide, const Image<std::int32_t>& map, int y,
                     std::int32_t* expected, std::uint8_t* bins) {
  const int width = map.width();
  if (guide.disparity == nullptr) {
    std::memset(bins, 0, width);
    return;
  }
  const int line = std::min(y / 2, guide.disparity->height() - 1);
  HWY_DYNAMIC_DISPATCH(spread)
  (guide.disparity->row(line), guide.confidence->row(line), (width + 1) / 2, expected, bins);
  HWY_DYNAMIC_DISPATCH(add_distances)(map.row(y), expected, width, bins);
}

}  // namespace mtstereo
#endif  // HWY_ONCE
