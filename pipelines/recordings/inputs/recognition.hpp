// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "recordings/inputs/recording.hpp"

namespace mtstereo::run {

/// Recognizes one recording: two video files, two folders (or patterns, left/%04d.png) of images,
/// one file or folder with both views side by side or one above the other, or a folder of a data
/// set (KITTI odometry and raw, EuRoC ASL, Middlebury and ETH3D pair folders). Decodes at most a
/// few frames. Throws UserError.
Recording recognize(const std::vector<std::string>& inputs, const InputOptions& options);

/// All recordings in a folder and the folders in it, sorted by name. What looks like a recording
/// and cannot be used is added to `problems`. Throws UserError if the folder cannot be read.
std::vector<Recording> find_recordings(const std::filesystem::path& archive,
                                       const InputOptions& options, std::vector<Problem>& problems);

/// The input and what is wrong with it. The reason may name the input, or a file in it.
std::string text_of(const Problem& problem, const std::string& between = ": ");

}  // namespace mtstereo::run
