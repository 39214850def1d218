// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mtstereo::eval {

/// The bytes of a file. Throws InputError where it is missing, no file, or cannot be read.
std::string read_bytes(const std::filesystem::path& file);

/// Writes a file, making its folder where there is none. Throws InputError.
void write_bytes(const std::filesystem::path& file, const std::string& bytes);

/// Makes the folder that this file is to be written to. Throws InputError.
void make_parent_folder(const std::filesystem::path& file);

/// The files right in a folder (not those in folders below), sorted by name; none where the folder
/// does not exist.
std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder);

/// A folder and all folders below it, sorted by path. Links to folders are followed once: a folder
/// that was already listed is not entered again. Throws InputError where one cannot be read.
std::vector<std::filesystem::path> folders_below(const std::filesystem::path& root);

/// The file's extension in lower case, with its dot.
std::string extension_of(const std::filesystem::path& file);

/// True for the extensions of the images that the data sets ship.
bool is_image(const std::filesystem::path& file);

}  // namespace mtstereo::eval
