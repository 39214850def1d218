// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/image.hpp"
#include "stages/prepare/camera_motion.hpp"
#include "stages/prepare/time_filter.hpp"

namespace mtstereo {

/// Moves the means of both views over time (time_filter.hpp) along the motion of the camera, block
/// by block: each block of the present view takes the means where its part of the scene was. The
/// time filter then decides, as for a camera at rest, which blocks continue these means.
///
/// Per frame: find_block_disparities() for all rows of blocks, find_moves() for each view, then
/// move_means() for all bands of its rows.

/// Where the pixels of the last map are in the input views: the pixel (X, Y) shows those from
/// (scale * X + column, scale * Y) on, and a disparity of D px stands for scale * D + column px.
struct MapPlace {
  int scale = 1;
  int column = 0;
};

/// Steps of an offset per px.
inline constexpr int kMoveShift = 3;
inline constexpr int kMoveOne = 1 << kMoveShift;

/// The disparity of a block about which the map knows nothing [px].
inline constexpr float kNoBlock = -1e9F;

/// The offsets of the blocks of a view: where each was in the last view, less where it is.
struct BlockMoves {
  /// The offset of a block whose place is unknown.
  static constexpr std::int16_t kUnknown = -32768;

  Image<std::int16_t> x;   ///< [1 / kMoveOne px]
  Image<std::int16_t> y;   ///< [1 / kMoveOne px]
  Image<float> disparity;  ///< of the nearest block of the last map that moved here, or kNoBlock

  /// For a view of this size.
  void resize(int width, int height, ReusedMemory* reused = nullptr);
};

/// Finds the disparities of the rows of blocks row0 .. row1 - 1 of the left view: medians of the
/// last map (0 = unknown) [1 / kHeldOne px]. `disparities` has a pixel for each block [px].
void find_block_disparities(const Image<std::uint16_t>& map, const MapPlace& place, int row0,
                            int row1, Image<float>& disparities);

/// Finds the offsets of the blocks of a view of this size, the left one (0) or the right one (1),
/// by the motion from the last pair to the present one. Blocks where the last map has nothing take
/// the offset of a block beside them.
void find_moves(const CameraMotion& motion, const Image<float>& disparities, int side, int width,
                int height, BlockMoves& moves);

/// The points of the last map in the input views.
void place_points(const MotionPoints& points, const MapPlace& place, MotionPoints& placed);

/// Moves the means `last` to the rows y0 .. y1 - 1. A block without a place takes the view, and has
/// no frames.
void move_means(GrayView view, const BlockMoves& moves, const Means& last, int y0, int y1,
                Means& moved);

}  // namespace mtstereo
