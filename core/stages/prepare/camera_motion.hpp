// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "base/buffer.hpp"
#include "mtstereo/image.hpp"
#include "stages/prepare/halving.hpp"

namespace mtstereo {

/// How the camera moved between two pairs of a stream, from their left views and the map of one of
/// them.
///
/// A pixel with a disparity is a point of the scene: column, row and disparity are its coordinates
/// up to a projective transformation, and so a motion of the camera transforms them projectively.
/// For the small angles between two frames that has eight unknowns, and neither the focal length
/// nor the baseline is needed. They are found by comparing gray values around the edges of the
/// views, from a small resolution to half of the full one (direct alignment).

/// Steps per px of the disparities of a map that is kept for the next pair.
inline constexpr int kHeldOne = 32;

/// A point of the scene in a left view.
struct ScenePoint {
  float x;          ///< [px]
  float y;          ///< [px]
  float disparity;  ///< [px]
};

/// Where the points of one view are in another one. Coordinates are relative to the center of the
/// view.
struct CameraMotion {
  float shift_x = 0;     ///< of a far point in the center [px]
  float shift_y = 0;     ///< [px]
  float roll = 0;        ///< about the optical axis [rad]
  float parallax_x = 0;  ///< shift by the disparity
  float parallax_y = 0;
  float approach = 0;  ///< growth by the disparity [1 / px]
  float turn_x = 0;    ///< growth by the column [1 / px]
  float turn_y = 0;    ///< growth by the row [1 / px]

  /// Depths become at least this share of what they are.
  static constexpr float kLeastDepth = 0.1F;

  ScenePoint moved(const ScenePoint& from) const {
    const float depth = 1 - approach * from.disparity - turn_x * from.x - turn_y * from.y;
    const float growth = 1 / std::max(depth, kLeastDepth);
    return {(from.x + shift_x + roll * from.y - parallax_x * from.disparity) * growth,
            (from.y + shift_y - roll * from.x - parallax_y * from.disparity) * growth,
            from.disparity * growth};
  }
};

/// A left view at half of its size, and repeatedly halved.
struct ViewPyramid {
  static constexpr int kMostLevels = 5;
  static constexpr int kSmallestSide = 12;  ///< of a level [px]

  std::array<Image<std::uint8_t>, kMostLevels> levels;
  int count = 0;

  /// For a view of this size.
  void resize(int width, int height, ReusedMemory* reused = nullptr);
  /// Takes the contents of a pyramid of the same size.
  void take(const ViewPyramid& other);
};

/// The points that are compared: one in each block of a grid, or none.
struct MotionPoints {
  static constexpr int kMostBlocks = 500;
  static constexpr int kSmallestBlock = 8;  ///< side [px]

  Buffer<ScenePoint>
      points;  ///< of the blocks, row by row; relative to the first pixel of the view
  int side = kSmallestBlock;  ///< of a block, even [px]
  int columns = 0;            ///< of blocks
  int rows = 0;

  /// For a view of this size.
  void resize(int width, int height);
};

/// Chooses the points of the rows of blocks row0 .. row1 - 1: where the halved view changes most,
/// of the pixels whose disparities are matched. A block without such a pixel has a point with a
/// negative disparity. `offset` is what a disparity of 0 px of the map stands for [px].
void choose_points(const Image<std::uint8_t>& halved, const Image<std::int32_t>& map,
                   const Image<std::uint8_t>& confidence, float offset, int row0, int row1,
                   MotionPoints& points);

/// The motion from the view that has the points to another one, both of this size. Nothing if they
/// do not show the same scene, as after a cut, or if too little can be compared.
std::optional<CameraMotion> find_motion(const MotionPoints& points, const ViewPyramid& from,
                                        const ViewPyramid& to, int width, int height);

}  // namespace mtstereo
