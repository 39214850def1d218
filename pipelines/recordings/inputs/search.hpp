// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "recordings/inputs/data_sets.hpp"
#include "recordings/inputs/recording.hpp"

namespace mtstereo::run {

/// What is in a folder, without the folders in it that are not part of a recording.
struct FolderContents {
  std::vector<Recording> recordings;
  std::vector<Problem> problems;
  std::vector<std::filesystem::path> used_folders;  ///< in which nothing else is searched
};

/// Searches a folder. `asked`: the user has named it, so that images of any kind in it count.
FolderContents search_folder(const std::filesystem::path& folder, const InputOptions& options,
                             bool asked);

/// Looks at the first frames: checks the sizes, finds the arrangement of one source, and chooses
/// the calibration. Throws UserError.
Recording completed(FoundRecording found, const InputOptions& options);

/// A source by what the user gives: a video, an image, a pattern, a folder with images or with
/// one video. Images are not checked. Throws UserError.
Source source_of(const std::string& input);

/// A recording of one or two such sources, for completed(). Throws UserError.
FoundRecording recording_of(const Source& left, const Source& right, const InputOptions& options);

}  // namespace mtstereo::run
