// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "mtstereo/geometry/calibration.hpp"

namespace mtstereo {

/// The text of the file of write_calibration(). `date` is used if the calibration has none.
std::string calibration_text(const StereoCalibration& calibration, const std::string& date);

}  // namespace mtstereo
