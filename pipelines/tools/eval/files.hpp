// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mtstereo::eval {

/// The bytes of a file. Throws UserError if it is missing, not a file, or unreadable.
std::string read_bytes(const std::filesystem::path& file);

/// Writes a file and creates its folder if needed. Throws UserError.
void write_bytes(const std::filesystem::path& file, const std::string& bytes);

/// Creates the folder of a file that is about to be written. Throws UserError.
void make_parent_folder(const std::filesystem::path& file);

/// The files of a folder, without those of its subfolders, sorted by name; none if the folder does
/// not exist.
std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder);

/// A folder and all its subfolders, sorted by path. Links to folders are followed once: a folder
/// that was already listed is not entered again. Throws UserError if one cannot be read.
std::vector<std::filesystem::path> folders_below(const std::filesystem::path& root);

}  // namespace mtstereo::eval
