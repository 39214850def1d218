// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>

namespace mtstereo::eval {

/// Reads a portable float map of one channel ("Pf") into CV_32FC1, first row on top (the file has
/// the last row first). A negative scale means little-endian values, a positive one big-endian;
/// its magnitude is ignored, because the stereo data sets do not use it. Header lines may end in
/// white space and comments (#). Throws UserError, naming the file and the reason.
cv::Mat read_pfm(const std::filesystem::path& file);

/// Writes CV_32FC1 as a little-endian portable float map. Throws UserError.
void write_pfm(const std::filesystem::path& file, const cv::Mat& values);

}  // namespace mtstereo::eval
