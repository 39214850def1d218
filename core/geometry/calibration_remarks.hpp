// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string_view>

#include "mtstereo/geometry/calibration.hpp"

// What read_calibration() changes or finds unusual, as StereoCalibration::remarks.

namespace mtstereo {

/// Exchanges the cameras if the first one is to the right of the second one, and notes that.
void put_in_order(StereoCalibration& calibration);

/// Parallel cameras without distortion that are equal, with square pixels, are a rectified pair:
/// adds that rectification, unless there is one.
void state_rectification(StereoCalibration& calibration);

/// Notes a baseline that no usual pair of cameras has, for a file that does not state the unit of
/// its lengths. `remedy` is what to do if they are not in `unit`.
void note_length(StereoCalibration& calibration, std::string_view remedy,
                 std::string_view unit = "meters");

/// Notes principal points that are far from the middle of their images. Unknown sizes are ignored.
void note_centers(StereoCalibration& calibration);

}  // namespace mtstereo
