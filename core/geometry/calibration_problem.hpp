// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "mtstereo/geometry/calibration.hpp"

// What the rectification requires of a calibration, whichever way it was made. check_calibration()
// refuses more: what is most likely a mistake.

namespace mtstereo {

/// Why images of the camera cannot be computed with, as the end of a sentence; "" if they can.
std::string camera_problem(const CameraCalibration& camera);

/// Why the relative pose of the cameras is invalid, as a sentence; "" if it is valid.
std::string pose_problem(const StereoCalibration& calibration);

}  // namespace mtstereo
