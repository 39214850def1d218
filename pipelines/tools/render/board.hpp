// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <vector>

#include "tools/render/image_texture.hpp"
#include "tools/render/raw.hpp"
#include "tools/render/scene.hpp"

namespace mtstereo::render {

/// How the poses of a calibration board are chosen.
struct BoardPoses {
  int count = 40;             ///< number of poses
  double smallest = 1.0 / 3;  ///< part of the width or height of the image that the board covers
  double largest = 2.0 / 3;   ///< the same, at most
  double tilt = 45;           ///< largest angle between the board and the plane across the ray
                              ///< through its center [degrees]
  double roll = 20;           ///< largest turn in the plane of the board [degrees]
  /// The part of the board that both cameras see at least. Below 1, some poses are partly outside
  /// of the views.
  double visible = 1;
  std::uint32_t seed = 1;  ///< of the poses
};

/// Poses of a board of this size [m] that together cover the image of the left camera: transforms
/// from the board to the left camera. The origin of the board is its center; x goes to the right
/// and y downwards on its face, z into the board. The poses depend only on the arguments. Throws
/// std::invalid_argument if the cameras have no place for the board in both views.
std::vector<Eigen::Isometry3d> choose_poses(const BoardPoses& options, double width, double height,
                                            const RawRig& rig);

/// The times of a board's path.
struct BoardTimes {
  double rest = 0;  ///< at each pose [s]
  double move = 1;  ///< from pose to pose, more than 0 [s]
};

/// A board that rests at each pose and moves to the next one, in front of a plain wall. The camera
/// does not move. The board arrives at pose i at the time i * (rest + move).
Scene make_board(const std::shared_ptr<const ImageTexture>& image,
                 std::vector<Eigen::Isometry3d> poses, const BoardTimes& times, std::uint32_t seed);

}  // namespace mtstereo::render
