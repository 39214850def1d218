// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <random>
#include <vector>

#include "programs/calibrate/board.hpp"
#include "programs/calibrate/bundle.hpp"
#include "programs/calibrate/detection.hpp"

namespace mtstereo::calibrate::testing {

/// Cameras of 640x480 px, 12 cm apart, slightly turned, with the distortion of a cheap lens.
Rig plumb_bob_rig();
/// The same with fisheye lenses that see 120 degrees across.
Rig fisheye_rig();

/// Poses of a board that is held in front of the left camera in all parts of its image.
std::vector<Pose> board_poses(const Rig& rig, const BoardOptions& board, int count,
                              std::uint32_t seed = 1);

/// What a camera sees of the board: the corners inside of its image, with noise of this standard
/// deviation [px].
std::vector<Observation> observe(const Camera& camera, const Pose& camera_from_board,
                                 const BoardOptions& board, double noise, std::mt19937& random);

/// The views of these poses that both cameras see enough of.
std::vector<BoardView> observe(const Rig& rig, const std::vector<Pose>& poses,
                               const BoardOptions& board, double noise, std::uint32_t seed = 1);

/// The views of `count` such poses of the usual board.
std::vector<BoardView> views_of(const Rig& rig, int count, double noise);

/// The corners as a detector finds them.
CornerPair corners_of(const BoardView& view);

}  // namespace mtstereo::calibrate::testing
