// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

namespace mtstereo {

/// What the path of read_calibration() names.
struct CalibrationPath {
  std::vector<std::string> files;  ///< one to three
  std::string selection;           ///< what follows '#', or empty
};

/// Splits "FILE", "FILE,FILE", "FILE,FILE,FILE" and "FILE#SELECTION". A file whose own name has
/// such characters is found if it exists.
CalibrationPath split_calibration_path(const std::string& path);

}  // namespace mtstereo
