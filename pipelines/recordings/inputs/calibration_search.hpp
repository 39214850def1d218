// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "recordings/inputs/data_sets.hpp"

namespace mtstereo::run {

/// What may be the calibration of a recording by its name, for read_calibration(): the files in
/// these folders.
std::vector<std::string> calibrations_in(const std::vector<std::filesystem::path>& folders);

/// Those that may be for all recordings in `folder`, or in a folder around it up to the one
/// `levels` above: files, and those of folders such as calibration/ and camera/. There, what has
/// the name of the scene counts first: camera/train/ulm for leftImg8bit/train/ulm and
/// rightImg8bit/train/ulm.
std::vector<CalibrationLevel> calibrations_above(const std::filesystem::path& left,
                                                 const std::filesystem::path& right,
                                                 std::filesystem::path folder, int levels);

}  // namespace mtstereo::run
