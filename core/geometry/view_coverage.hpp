// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "mtstereo/geometry/rectification.hpp"

// How much of an image a rectified view shows, and how much of the view that is. Sampled.

namespace mtstereo {

/// The part of the pixels of a rectified view that the camera sees [0 .. 1].
double seen_part(const StereoCalibration& calibration, const Rectification& rectification,
                 Rectifier::Side side);

/// Whether a rectified view shows any part of the camera's image.
bool shows_anything(const StereoCalibration& calibration, const Rectification& rectification,
                    Rectifier::Side side);

/// The part of the pixels of a camera's image whose direction the lens model does not cover [0 ..
/// 1].
double uncovered_part(const CameraCalibration& camera);

}  // namespace mtstereo
