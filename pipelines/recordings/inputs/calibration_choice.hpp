// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "recordings/inputs/recording.hpp"

namespace mtstereo::run {

/// What may be the calibration of a recording by its name, for read_calibration(): the files in
/// these folders.
std::vector<std::string> calibrations_in(const std::vector<std::filesystem::path>& folders);

/// Sets the calibration of a recording whose views have this size, and whether the views are
/// rectified. The calibration of the options is used, or the one of `beside` that can be read and
/// fits the size. The choice is a remark. Throws UserError for the one of the options, and if there
/// are several beside the input.
void choose_calibration(Recording& recording, const std::vector<std::string>& beside,
                        const InputOptions& options, int width, int height);

}  // namespace mtstereo::run
