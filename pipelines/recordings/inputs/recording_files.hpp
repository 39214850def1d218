// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "recordings/inputs/recording.hpp"

namespace mtstereo::run {

/// The files that a recording is read from, with those of its calibration.
std::vector<std::filesystem::path> recording_files(const Recording& recording);

}  // namespace mtstereo::run
