// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "programs/calibrate/bundle.hpp"

// What an adjustment starts from. Nothing about the cameras is known, and some corners may be
// wrong.

namespace mtstereo::calibrate {

/// A view with fewer corners is not used.
inline constexpr std::size_t kFewestCorners = 6;

/// The pose of the board in front of a known camera. std::nullopt if too few corners are in front
/// of it.
std::optional<Pose> board_pose(const Camera& camera, const std::vector<Observation>& seen);

/// Camera and poses (`views[i].pose`) that fit what one camera saw (`views[i].left`), by an
/// adjustment from several focal lengths. Throws UserError if none fits.
Camera fit_camera(Model model, int width, int height, std::vector<BoardView>& views);

/// Two cameras, and the poses of the board, from what both saw: each camera alone, then the pose
/// between them that most views agree on. Throws UserError.
Rig fit_start(Model model, cv::Size left, cv::Size right, std::vector<BoardView>& views);

/// The robust scale of residuals [px]: the standard deviation of their components if most are
/// normally distributed, at least `least`.
double robust_scale(const Rig& rig, const std::vector<BoardView>& views, double least);

}  // namespace mtstereo::calibrate
