// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "recordings/inputs/recording.hpp"

namespace mtstereo::run {

/// What is in a folder, without the folders in it that are not part of a recording.
struct FolderContents {
  std::vector<Recording> recordings;
  std::vector<Problem> problems;
  /// The first recording of ROS and the like. It may be what a recording in the folder was made of.
  std::optional<Problem> unread;
  std::vector<std::filesystem::path> used_folders;  ///< in which nothing else is searched
};

/// Searches a folder, and for its calibrations also the folders around it up to `named`, which the
/// user gave. `asked`: images of any kind in it count.
FolderContents search_folder(const std::filesystem::path& folder,
                             const std::filesystem::path& named, const InputOptions& options,
                             bool asked);

}  // namespace mtstereo::run
