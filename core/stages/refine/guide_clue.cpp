// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/guide_clue.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "stages/refine/reliability_table.hpp"

namespace mtstereo {
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

/// A row of the guide, and of the pixels that it is about: their expected disparities, and the
/// first bins of their levels.
struct GuideRow {
  /// Writes what a column says to the pixels x .. end - 1.
  void spread(int column, int x, int end) const {
    std::fill(expected + x, expected + end, scale * disparity[column] + added);
    std::fill(bins + x, bins + end, kLevelBins[confidence[column]]);
  }

  const std::int32_t* disparity;
  const std::uint8_t* confidence;
  int scale;
  std::int32_t added;
  std::int32_t* expected;
  std::uint8_t* bins;
};

/// The same for the columns first .. last - 1, whose pixels begin with pixel x.
template <int kScale>
void spread_columns(const GuideRow& row, int first, int last, int x) {
  std::int32_t* __restrict__ expected = row.expected + x;
  std::uint8_t* __restrict__ bins = row.bins + x;
  const std::int32_t* __restrict__ disparity = row.disparity + first;
  const std::uint8_t* __restrict__ confidence = row.confidence + first;
  for (int i = 0; i < last - first; ++i) {
    for (int k = 0; k < kScale; ++k) {
      expected[kScale * i + k] = kScale * disparity[i] + row.added;
      bins[kScale * i + k] = kLevelBins[confidence[i]];
    }
  }
}

/// Writes what the guide says to the pixels of row y. The first and the last column that show any
/// of them reach to the ends of the row.
void spread(const RatedGuide& guide, int y, int width, std::int32_t* expected, std::uint8_t* bins) {
  const int scale = guide.scale, offset = guide.column_offset;
  const int line = std::min(y / scale, guide.disparity->height() - 1);
  const GuideRow row = {guide.disparity->row(line),
                        guide.confidence->row(line),
                        scale,
                        guide.added * kDisparityOne,
                        expected,
                        bins};
  const int most = guide.disparity->width() - 1;
  const int first = std::clamp(offset / scale, 0, most);
  const int last = std::clamp((width - 1 + offset) / scale, first, most);
  // Where the columns after the first one begin, and where the last one begins.
  const int begin = std::clamp((first + 1) * scale - offset, 0, width);
  const int end = std::clamp(last * scale - offset, begin, width);
  row.spread(first, 0, begin);
  if (scale == 2) {
    spread_columns<2>(row, first + 1, first + 1 + (end - begin) / 2, begin);
  } else {
    spread_columns<4>(row, first + 1, first + 1 + (end - begin) / 4, begin);
  }
  row.spread(last, end, width);
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

}  // namespace

void find_guide_bins(const RatedGuide& guide, const Image<std::int32_t>& map, int y,
                     std::int32_t* expected, std::uint8_t* bins) {
  const int width = map.width();
  if (guide.disparity == nullptr) {
    std::memset(bins, 0, width);
    return;
  }
  spread(guide, y, width, expected, bins);
  add_distances(map.row(y), expected, width, bins);
}

}  // namespace mtstereo
