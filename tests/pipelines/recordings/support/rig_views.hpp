// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "mtstereo/geometry/calibration.hpp"

// Raw views of rendered stereo cameras.

namespace mtstereo::run::testing {

inline constexpr int kRigWidth = 320, kRigHeight = 200;

/// Two cameras as people build them: focal lengths, lenses (every fourth one a fisheye), principal
/// points, and turns of the right camera of up to 1.5 degrees are random.
StereoCalibration random_rig(int seed);

struct RawViews {
  cv::Mat left, right;  ///< gray
};

/// What the cameras see of a scene ("street", "garden", "room") at a time [s].
RawViews raw_views(const StereoCalibration& rig, const std::string& scene, double time = 0);

}  // namespace mtstereo::run::testing
