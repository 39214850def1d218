// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/block_grid.hpp"

#include <algorithm>
#include <cstring>

#include "stages/refine/reliability_table.hpp"

namespace mtstereo {
namespace {

static_assert(kGridDistances == kGridDistanceEnds.size() + 1);
static_assert(1 + kGridDistances * kGridLevelEnds.size() <= kClueBins);

template <int kSide>
BlockGrid measure_rows(DisparityView map, GrayView confidences, int y0, int y1) {
  constexpr int kLeast = least_grid_disparity(kSide) * kDisparityOne;
  BlockGrid grid;
  const int first = (y0 + kBlockRows - 1) / kBlockRows * kBlockRows;
  for (int y = first; y < y1; y += kBlockRows) {
    const std::int32_t* disparity = map.row(y);
    const std::uint8_t* confidence = confidences.row(y);
    int whole = 0, blocks = 0;
    for (int x = 0; x < map.width; ++x) {
      const bool counts = (disparity[x] != kNoDisparity) & (confidence[x] > kMostInferred) &
                          (disparity[x] >= kLeast);
      const int above = disparity[x] + kGridWhole;
      whole += counts & (above % kDisparityOne <= 2 * kGridWhole);
      blocks += counts & (above % (kSide * kDisparityOne) <= 2 * kGridWhole);
    }
    grid.add({whole, blocks});
  }
  return grid;
}

}  // namespace

void BlockGrid::add(const BlockGrid& other) {
  whole += other.whole;
  blocks += other.blocks;
}

int BlockGrid::level(const BlockBorders& left) const {
  if (whole < kLeastGridPoints || !left.visible()) return 0;
  const auto expected = static_cast<double>(whole - blocks) / (left.side - 1);
  const double excess = static_cast<double>(blocks) / std::max(expected, 1.0);
  return static_cast<int>(std::count_if(kGridLevelEnds.begin(), kGridLevelEnds.end(),
                                        [&](double end) { return excess >= end; }));
}

BlockGrid measure_grid(DisparityView disparity, GrayView confidence, int side, int y0, int y1) {
  return side == kBlockSide ? measure_rows<kBlockSide>(disparity, confidence, y0, y1)
                            : measure_rows<kHalvedBlockSide>(disparity, confidence, y0, y1);
}

void find_grid_bins(int level, int side, const std::int32_t* __restrict__ map, int width,
                    std::uint8_t* __restrict__ bins) {
  if (level == 0) {
    std::memset(bins, 0, width);
    return;
  }
  const int block = side * kDisparityOne;
  const int least = least_grid_disparity(side) * kDisparityOne;
  const int first = 1 + kGridDistances * (level - 1);
  for (int x = 0; x < width; ++x) {
    const int beyond = (map[x] + block / 2) & (block - 1);  // of the block's border, plus a half
    const int distance = beyond > block / 2 ? beyond - block / 2 : block / 2 - beyond;
    const int counted = map[x] < least ? block : distance;
    int bin = first;
    for (const int end : kGridDistanceEnds) bin += counted >= end;
    bins[x] = static_cast<std::uint8_t>(bin);
  }
}

}  // namespace mtstereo
