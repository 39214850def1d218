// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "recordings/inputs/data_sets.hpp"
#include "recordings/inputs/recording.hpp"

namespace mtstereo::run {

/// The images of a folder, or of the folder data or images in it.
std::vector<std::filesystem::path> images_of_folder(const std::filesystem::path& folder);

/// The videos of a folder, without the results of earlier runs.
std::vector<std::filesystem::path> videos_in(const std::filesystem::path& folder);

/// Removes the results of earlier runs from what is in a folder.
void erase_results(std::vector<std::filesystem::path>& paths, const std::filesystem::path& folder);

/// Whether a folder has the results of an earlier run, or a plan: it is not a recording.
bool is_result(const std::filesystem::path& folder);

/// A source by what the user gives: a video, an image, a pattern, a folder with images or with
/// one video. Images are not checked. Throws UserError.
Source source_of(const std::string& input);

/// The file of a source, or its first one.
const std::filesystem::path& file_of(const Source& source);

/// The name without its extension, or that of the folder if nothing is left of it.
std::string name_without_extension(const std::string& name, const std::filesystem::path& folder);

/// A recording of one or two such sources, for completed(). Throws UserError.
FoundRecording recording_of(const Source& left, const Source& right, const InputOptions& options);

}  // namespace mtstereo::run
