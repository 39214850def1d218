// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "recordings/inputs/recording.hpp"

// What a work was prepared from, in the file NAME.key beside it.

namespace mtstereo::run {

/// What a work was prepared from.
struct WorkKey {
  /// Differs if a recording would be prepared in another way: by its paths, the sizes and times of
  /// its files, or the settings.
  std::string all;
  std::vector<std::int64_t> sizes;  ///< of the files [bytes]; -1: missing

  bool operator==(const WorkKey& other) const = default;
};

/// The key of a recording. Its files are not read.
WorkKey work_key(const Recording& recording, const std::string& settings);

/// The first file of a recording that has another size than when the key was made, or that is
/// missing; empty if there is none.
std::filesystem::path changed_file(const Recording& recording, const WorkKey& key);

/// Writes a key. Throws UserError.
void write_key(const WorkKey& key, const std::filesystem::path& file);
/// Reads it; empty if there is none.
WorkKey read_key(const std::filesystem::path& file);

}  // namespace mtstereo::run
