// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>

namespace mtstereo::apps {

/// Compares depths with the ground truth of their clip, and prints one row for each range of true
/// depths. `depths`: a folder of 16-bit PNG images in millimeters, 0 = none. `truths`: a folder
/// of PFM files with the same names, in meters; values that are not finite are unknown. Throws
/// std::runtime_error if a frame is missing or has another size.
void print_depth_errors(const std::filesystem::path& depths, const std::filesystem::path& truths);

}  // namespace mtstereo::apps
