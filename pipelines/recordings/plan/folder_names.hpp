// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>

// Names of folders and files that several processes, maybe of several machines, use at the same
// time.

namespace mtstereo::run {

/// A name in `parent` that no other process has: `label`, host, process and random numbers.
std::filesystem::path unused_name(const std::filesystem::path& parent, const std::string& label);

/// Renames a folder. Returns whether `from` is now `to`; not if there is a folder with files
/// already. Throws UserError.
bool rename_folder(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace mtstereo::run
