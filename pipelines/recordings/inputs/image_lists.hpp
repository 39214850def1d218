// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "recordings/inputs/recording.hpp"

namespace mtstereo::run {

/// Why an image cannot be read, by its first and last bytes: such as "is empty" or "is truncated";
/// "" if nothing is wrong with these.
std::string image_problem(const std::filesystem::path& image);

/// Sets the images of a recording, one list or two. Images that are broken are left out with a
/// remark. The times of the others are set where the numbers in their names, the times in their
/// names, or images left out need it: frames that belong together get the same time. Throws
/// UserError if a list has no image that can be read.
void set_images(Recording& recording, const std::vector<std::filesystem::path>& left,
                const std::vector<std::filesystem::path>& right, double frame_rate);

/// Sets images whose times are known, in this order; the lists of times have the same lengths.
void set_timed_images(Recording& recording, const Source& left, const Source& right);

}  // namespace mtstereo::run
