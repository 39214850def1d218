// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace mtstereo::apps {

/// The files of a folder with this extension, by their names without it. Throws std::runtime_error
/// if there is none.
std::map<std::string, std::filesystem::path> by_name(const std::filesystem::path& folder,
                                                     const std::string& extension);

/// The file of a frame. Throws std::runtime_error, naming the folder, if it is missing.
const std::filesystem::path& partner(const std::map<std::string, std::filesystem::path>& files,
                                     const std::filesystem::path& folder, const std::string& name);

}  // namespace mtstereo::apps
