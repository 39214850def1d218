// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string_view>

namespace mtstereo::outputs {

/// Writes a file aside and renames it. Replaces a regular file of this name, and nothing else.
/// Throws UserError.
void write_file(const std::filesystem::path& file, std::string_view bytes);

/// Gives a file or a folder another name on the same file system, unless something has this name;
/// only an empty folder is replaced, by a folder. Throws UserError.
void move_file(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace mtstereo::outputs
