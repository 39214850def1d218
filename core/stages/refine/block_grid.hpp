// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>

#include "mtstereo/image.hpp"

namespace mtstereo {

/// The blocks of compressed views, and how often a map has matched them instead of the scene.
///
/// JPEG and most video codecs divide each view into blocks of 8x8 px, at the same places in both
/// views. Where the scene has little texture, blocks look like the blocks next to them: their
/// borders and patterns match at disparities that are multiples of the block size, with great
/// confidence.

/// Side of a block [px], and the same in halved views.
inline constexpr int kBlockSide = 8;
inline constexpr int kHalvedBlockSide = kBlockSide / 2;

/// The rows that are measured: one of so many.
inline constexpr int kGridRows = 4;

/// A disparity is nearly whole up to this distance from a whole one [1 / kDisparityOne px].
inline constexpr int kGridWhole = kDisparityOne / 8;

/// Smaller disparities are those of the far distance rather than of the blocks [px].
constexpr int least_grid_disparity(int side) { return side / 2; }

/// With fewer nearly whole disparities, there is no level.
inline constexpr int kLeastGridPoints = 250;

/// The borders of blocks show if the steps there are at least this many times those elsewhere, and
/// more in small views, whose edges may lie in some columns by chance: kGridChance divided by the
/// square root of the number of steps in each column.
inline constexpr double kVisibleGrid = 1.05;
inline constexpr double kGridChance = 6;

/// The levels: how many times as often as other whole disparities the map has multiples of the
/// block size, at least. Level 0 is below.
inline constexpr std::array kGridLevelEnds = {1.2, 1.6, 2.3, 3.3};

/// Sums over some rows. They are whole numbers, and the same in any order.
struct BlockGrid {
  int side = kBlockSide;  ///< of a block in the views, a power of two [px]
  /// By the column of the right pixel modulo `side`: the steps of the gray value between
  /// neighbors that exceed the mean step on both sides, up to 4 each [half gray values].
  std::array<std::int64_t, kBlockSide> steps{};
  std::int64_t count = 0;   ///< of the steps in each of these sums
  std::int64_t whole = 0;   ///< nearly whole disparities
  std::int64_t blocks = 0;  ///< those at multiples of `side`

  /// Adds the sums of other rows of the same views.
  void add(const BlockGrid& other);

  /// 0 .. kGridLevelEnds.size(); 0 if the view shows no blocks, or the map does not match them.
  int level() const;
};

/// What is measured. `disparity` and `confidence` belong to the left view.
struct GridViews {
  GrayView left;
  DisparityView disparity;
  GrayView confidence;  ///< above kMostInferred for the pixels that count
  int side;             ///< of a block in the views, kBlockSide or kHalvedBlockSide [px]
};

/// Measures the rows y0 .. y1 - 1.
BlockGrid measure_grid(const GridViews& views, int y0, int y1);

/// The bins of the clue about blocks (reliability_table.hpp) for a row of `width` disparities. Bin
/// 0 is that of level 0, the others have kGridDistances for each level.
inline constexpr std::array kGridDistanceEnds = {26, 64, 128, 256};  ///< [1 / kDisparityOne px]
inline constexpr int kGridDistances = 5;
void find_grid_bins(int level, int side, const std::int32_t* map, int width, std::uint8_t* bins);

}  // namespace mtstereo
