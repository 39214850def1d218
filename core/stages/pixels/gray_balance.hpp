// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/image.hpp"
#include "stages/pixels/gray_mapping.hpp"

namespace mtstereo {

/// How much brighter the left view is than the right one, place by place. Beside the cameras'
/// responses, vignetting and the angle of the light make the same surface brighter in one view than
/// in the other, by an amount that changes slowly along the view. The pixels that are matched at
/// half the resolution say how much.

/// Side of a tile [px of half the resolution].
inline constexpr int kBalanceTile = 16;

/// Every so many of its rows and columns are read.
inline constexpr int kBalanceStep = 2;

/// A tile with fewer matched pixels than this among those that are read has no difference.
inline constexpr int kFewestBalanced = 8;

/// Tiles on each side of a tile that count for it.
inline constexpr int kBalanceReach = 2;

/// Stands for a tile without a difference.
inline constexpr std::int16_t kNoDifference = 256;

/// How the gray values of both views differ. Differences are those of the left minus the mapped
/// right view, in tiles of the views at half the resolution.
struct GrayBalance {
  /// For views of this size at half the resolution.
  void resize(int width, int height);

  GrayMapping mapping;         ///< of the whole view
  Image<std::int16_t> own;     ///< the median of each tile's matched pixels
  Image<std::int16_t> around;  ///< the median of a tile and those around it
};

/// Writes the tiles' own differences in the tile rows row0 .. row1 - 1. The views are those at half
/// the resolution, and the map is theirs.
void measure_differences(GrayView left, GrayView right, const Image<std::int32_t>& map, int row0,
                         int row1, GrayBalance& balance);

/// The median of the tiles' own differences, 0 if no tile has one.
std::int16_t common_difference(const GrayBalance& balance);

/// Writes the differences around the tiles of the rows row0 .. row1 - 1, from their own. A tile
/// gets the common one if no tile around it has one.
void balance_tiles(std::int16_t common, int row0, int row1, GrayBalance& balance);

/// Writes row y of a left view as bright as the mapped right view, at a resolution at which a tile
/// has this side [px].
void balance_row(GrayView left, int y, const GrayBalance& balance, int tile, std::uint8_t* out);

}  // namespace mtstereo
