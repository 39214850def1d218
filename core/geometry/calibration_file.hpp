// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "mtstereo/geometry/calibration.hpp"

// The parts of read_calibration() and write_calibration().

namespace mtstereo {

/// What the path of read_calibration() names.
struct CalibrationPath {
  std::vector<std::string> files;  ///< one or two
  std::string selection;           ///< what follows '#', or empty
};

/// Splits "FILE", "FILE,FILE" and "FILE#SELECTION". A file whose own name has such characters is
/// found if it exists.
CalibrationPath split_calibration_path(const std::string& path);

/// The text of the file of write_calibration(). `date` is used if the calibration has none.
std::string calibration_text(const StereoCalibration& calibration, const std::string& date);

}  // namespace mtstereo
