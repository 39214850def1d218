// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace mtstereo::files {

/// The order of numbered files: digits are compared as numbers, so that 9.png is before 10.png.
bool numbered_less(std::string_view a, std::string_view b);

/// The last digits in a name without its extension, such as "0012" of left_0012.png; empty if there
/// are none.
std::string last_digits(const std::filesystem::path& file);
/// The same without leading zeros.
std::string last_number(const std::filesystem::path& file);

/// The extension in lower case, with its dot.
std::string extension_of(const std::filesystem::path& file);
/// The name without its extension, in lower case.
std::string lower_stem(const std::filesystem::path& file);
/// By its extension: an image that OpenCV reads.
bool is_image(const std::filesystem::path& file);
/// The same: a JPEG image, also one with both views (.jps).
bool is_jpeg(const std::filesystem::path& file);
/// By its extension: a container with video, or a stream of it.
bool is_video(const std::filesystem::path& file);

/// Whether a folder is there.
bool is_folder(const std::filesystem::path& path);
/// The files or the folders in a folder in the order of numbered files, without hidden ones; none
/// if it cannot be read.
std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder);
std::vector<std::filesystem::path> folders_in(const std::filesystem::path& folder);
/// The images in a folder in the order of numbered files.
std::vector<std::filesystem::path> images_in(const std::filesystem::path& folder);

/// Whether a path is a pattern of files: with a number, such as left/%04d.png, or of a shell, such
/// as left/*.png.
bool is_pattern(const std::string& path);
/// The files that exist of a pattern, in the order of numbered files. Throws UserError for a
/// pattern with % that has not exactly one number.
std::vector<std::filesystem::path> files_of_pattern(const std::string& pattern);

}  // namespace mtstereo::files
