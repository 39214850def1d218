// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/guide_clue.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "stages/refine/reliability_table.hpp"

#define HWY_TARGET_INCLUDE "stages/refine/guide_clue.cpp"
#include "base/simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

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

HWY_EXPORT(add_distances);

namespace {

static_assert(kGuideLevels * kGuideDistances == kClueBins);

/// The first bin of the level of each confidence.
constexpr std::array<std::uint8_t, 256> kLevelBins = [] {
  std::array<std::uint8_t, 256> bins{};
  for (int confidence = 0; confidence < 256; ++confidence) {
    const int level = (confidence - kLeastGuideConfidence) / kGuideLevel;
    const int limited = std::clamp(level, 0, kGuideLevels - 1);
    bins[confidence] = static_cast<std::uint8_t>(kGuideDistances * limited);
  }
  return bins;
}();

/// Writes what the guide says to the pixels of row y: its pixel is two of the row.
void spread(const RatedGuide& guide, int y, int width, std::int32_t* __restrict__ expected,
            std::uint8_t* __restrict__ bins) {
  const int line = std::min(y / 2, guide.disparity->height() - 1);
  const std::int32_t* __restrict__ disparity = guide.disparity->row(line);
  const std::uint8_t* __restrict__ confidence = guide.confidence->row(line);
  // Compilers vectorize the first loop.
  for (int i = 0; i < width / 2; ++i) expected[2 * i] = expected[2 * i + 1] = 2 * disparity[i];
  for (int i = 0; i < width / 2; ++i) bins[2 * i] = bins[2 * i + 1] = kLevelBins[confidence[i]];
  if (width % 2 == 0) return;
  expected[width - 1] = 2 * disparity[width / 2];
  bins[width - 1] = kLevelBins[confidence[width / 2]];
}

}  // namespace

void find_guide_bins(const RatedGuide& guide, const Image<std::int32_t>& map, int y,
                     std::int32_t* expected, std::uint8_t* bins) {
  const int width = map.width();
  if (guide.disparity == nullptr) {
    std::memset(bins, 0, width);
    return;
  }
  spread(guide, y, width, expected, bins);
  HWY_DYNAMIC_DISPATCH(add_distances)(map.row(y), expected, width, bins);
}

}  // namespace mtstereo
#endif  // HWY_ONCE
