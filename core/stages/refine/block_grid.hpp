// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>

#include "mtstereo/image.hpp"
#include "stages/prepare/block_borders.hpp"

namespace mtstereo {

/// How often a map has matched the blocks of compressed views instead of the scene. They are at the
/// same places in both views. Where the scene has little texture, blocks look like the blocks next
/// to them: their borders and patterns match at disparities that are multiples of the block size,
/// with great confidence.

/// A disparity is nearly whole up to this distance from a whole one [1 / kDisparityOne px].
inline constexpr int kGridWhole = kDisparityOne / 8;

/// Smaller disparities are those of the far distance rather than of the blocks [px].
constexpr int least_grid_disparity(int side) { return side / 2; }

/// With fewer nearly whole disparities, there is no level.
inline constexpr int kLeastGridPoints = 250;

/// The levels: how many times as often as other whole disparities the map has multiples of the
/// block size, at least. Level 0 is below.
inline constexpr std::array kGridLevelEnds = {1.2, 1.6, 2.3, 3.3};

/// Sums over some rows.
struct BlockGrid {
  std::int64_t whole = 0;   ///< nearly whole disparities
  std::int64_t blocks = 0;  ///< those at multiples of the block size

  /// Adds the sums of other rows of the same map.
  void add(const BlockGrid& other);

  /// 0 .. kGridLevelEnds.size(); 0 if the left view shows no blocks, or the map does not match
  /// them.
  int level(const BlockBorders& left) const;
};

/// Measures the rows y0 .. y1 - 1 of the map of the left view. Only pixels whose confidence is
/// above kMostInferred count. `side` is that of a block in the views, kBlockSide or
/// kHalvedBlockSide [px].
BlockGrid measure_grid(DisparityView disparity, GrayView confidence, int side, int y0, int y1);

/// The bins of the clue about blocks (reliability_table.hpp) for a row of `width` disparities. Bin
/// 0 is that of level 0, the others have kGridDistances for each level.
inline constexpr std::array kGridDistanceEnds = {26, 64, 128, 256};  ///< [1 / kDisparityOne px]
inline constexpr int kGridDistances = 5;
void find_grid_bins(int level, int side, const std::int32_t* map, int width, std::uint8_t* bins);

}  // namespace mtstereo
