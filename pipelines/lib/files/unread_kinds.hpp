// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mtstereo::files {

/// What a file of a kind that no program here reads is, and how its views are converted: by its
/// extension, such as .heic or .bag, or as a GIF by its first bytes. "" for all other files.
std::string unread_kind(const std::filesystem::path& file);

/// The first of some files that is of such a kind, with what unread_kind() states: "FILE: is ...".
/// "" if there is none.
std::string first_unread(const std::vector<std::filesystem::path>& files);

/// Those of some files that are recordings of both views in such a kind, by their extensions only.
std::vector<std::filesystem::path> unread_recordings(std::vector<std::filesystem::path> files);

/// Whether a file is a photo of such a kind, by its extension only.
bool is_unread_photo(const std::filesystem::path& file);

/// Throws UserError for a file of such a kind.
void refuse_unread(const std::filesystem::path& file);

}  // namespace mtstereo::files
