// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <vector>

#include "programs/calibrate/lens.hpp"

// Bundle adjustment: the cameras, their relative pose and the poses of the board that fit the
// corners in all views best. By hand on purpose: Levenberg-Marquardt takes 130 lines here, and
// Ceres would add 25 packages to every build.

namespace mtstereo::calibrate {

/// One corner of the board in one view.
struct Observation {
  int id = 0;             ///< of the corner
  Eigen::Vector3d point;  ///< on the board [m]
  Eigen::Vector2d pixel;  ///< where it was found [px]
  double weight = 1;      ///< 0: not used
};

/// The corners that both cameras see at one time.
struct BoardView {
  std::vector<Observation> left;
  std::vector<Observation> right;
  Pose pose;  ///< left camera from board
};

/// What is adjusted.
struct BundleOptions {
  std::array<bool, kMostParameters> free{};  ///< parameters of both cameras
  bool free_rig = true;                      ///< the pose between the cameras
  /// Distance at which an observation has half of its weight [px] (Cauchy); 0 = least squares.
  double robust_scale = 0;
  int iterations = 60;
};

/// All parameters of the cameras.
std::array<bool, kMostParameters> all_parameters();
/// No parameter: only poses are adjusted.
std::array<bool, kMostParameters> no_parameters();

struct BundleResult {
  double rms = 0;        ///< of the distances of the observations in use [px]
  int observations = 0;  ///< in use
  bool converged = false;
  /// Covariance of the free parameters of the left camera, the right camera, and the six of
  /// Pose::moved() of the pose between them. Empty if the views do not determine them, and for
  /// robust adjustments.
  Eigen::MatrixXd covariance;
};

/// Changes `rig` and the poses of `views` to a minimum of the squared distances
/// (Levenberg-Marquardt; the poses of the board are eliminated by the Schur complement).
/// Observations without an image in the model count as far away.
BundleResult adjust(Rig& rig, std::vector<BoardView>& views, const BundleOptions& options);

/// Measured minus projected position of each observation [px].
std::vector<Eigen::Vector2d> residuals(const Camera& camera, const Pose& pose,
                                       const std::vector<Observation>& seen);

/// The parameters of the left camera, the right camera and the pose between them that are free,
/// in the order of the covariance, changed by `step`.
Rig moved(const Rig& rig, const BundleOptions& options, const Eigen::VectorXd& step);

/// The number of these parameters.
int free_count(const Rig& rig, const BundleOptions& options);

}  // namespace mtstereo::calibrate
