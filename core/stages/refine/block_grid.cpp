// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/block_grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "stages/refine/reliability_table.hpp"

namespace mtstereo {
namespace {

static_assert(kGridDistances == kGridDistanceEnds.size() + 1);
static_assert(1 + kGridDistances * kGridLevelEnds.size() <= kClueBins);

/// The first column whose step is measured; all columns have equally many.
constexpr int kFirstColumn = 2;

/// The most that a step counts [half gray values]. Edges of the scene are larger than most steps
/// between blocks.
constexpr int kMostStep = 8;

/// Adds the steps of a row, whole blocks of columns.
template <int kSide>
void add_steps(const std::uint8_t* row, int width, BlockGrid& grid) {
  std::array<int, kSide> sums{};
  for (int x = kFirstColumn; x + kSide < width; x += kSide) {
    const std::uint8_t* at = row + x;
    ++grid.count;
    for (int i = 0; i < kSide; ++i) {
      const int before = std::abs(at[i - 1] - at[i - 2]), after = std::abs(at[i + 1] - at[i]);
      const int step = 2 * std::abs(at[i] - at[i - 1]) - before - after;
      sums[i] += std::min(std::max(step, 0), kMostStep);
    }
  }
  for (int i = 0; i < kSide; ++i) grid.steps[(kFirstColumn + i) % kSide] += sums[i];
}

template <int kSide>
void add_disparities(const GridViews& views, int y, BlockGrid& grid) {
  const std::int32_t* disparity = views.disparity.row(y);
  const std::uint8_t* confidence = views.confidence.row(y);
  constexpr int kLeast = least_grid_disparity(kSide) * kDisparityOne;
  int whole = 0, blocks = 0;
  for (int x = 0; x < views.left.width; ++x) {
    const bool counts =
        (disparity[x] != kNoDisparity) & (confidence[x] > kMostInferred) & (disparity[x] >= kLeast);
    const int above = disparity[x] + kGridWhole;
    whole += counts & (above % kDisparityOne <= 2 * kGridWhole);
    blocks += counts & (above % (kSide * kDisparityOne) <= 2 * kGridWhole);
  }
  grid.whole += whole;
  grid.blocks += blocks;
}

template <int kSide>
BlockGrid measure_rows(const GridViews& views, int y0, int y1) {
  BlockGrid grid;
  grid.side = kSide;
  const int first = (y0 + kGridRows - 1) / kGridRows * kGridRows;
  for (int y = first; y < y1; y += kGridRows) {
    add_steps<kSide>(views.left.row(y), views.left.width, grid);
    add_disparities<kSide>(views, y, grid);
  }
  return grid;
}

}  // namespace

void BlockGrid::add(const BlockGrid& other) {
  for (std::size_t i = 0; i < steps.size(); ++i) steps[i] += other.steps[i];
  count += other.count;
  whole += other.whole;
  blocks += other.blocks;
}

int BlockGrid::level() const {
  if (whole < kLeastGridPoints || count == 0) return 0;
  std::int64_t all = 0;
  for (const std::int64_t sum : steps) all += sum;
  // Views that were cropped begin within a block.
  const std::int64_t borders = *std::max_element(steps.begin(), steps.end());
  const auto others = static_cast<double>(all - borders) / (side - 1);
  const double visible = kVisibleGrid + kGridChance / std::sqrt(static_cast<double>(count));
  if (static_cast<double>(borders) < visible * others) return 0;
  const auto expected = static_cast<double>(whole - blocks) / (side - 1);
  const double excess = static_cast<double>(blocks) / std::max(expected, 1.0);
  return static_cast<int>(std::count_if(kGridLevelEnds.begin(), kGridLevelEnds.end(),
                                        [&](double end) { return excess >= end; }));
}

BlockGrid measure_grid(const GridViews& views, int y0, int y1) {
  return views.side == kBlockSide ? measure_rows<kBlockSide>(views, y0, y1)
                                  : measure_rows<kHalvedBlockSide>(views, y0, y1);
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
