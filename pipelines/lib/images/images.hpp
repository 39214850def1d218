// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <string_view>
#include <vector>

// Image files by OpenCV. Its library of formats is loaded by the first call, not at the start of
// the program. All functions can be called by several threads. They throw cv::Exception where
// OpenCV does, but for read(), and UserError if the library cannot be loaded.
namespace mtstereo::images {

/// The image in a file; empty if the file is missing, no image, or refused by OpenCV, as one of
/// more than 2^30 pixels. cv::Exception only for a lack of memory. Flags are those of cv::imread().
cv::Mat read(const std::filesystem::path& file, int flags);

/// Throws UserError for an image that programs turn when they show it, as its EXIF data state:
/// decoders of frames do not.
void refuse_turned(const std::filesystem::path& image);

/// The image in the bytes of a file; empty if they are none. Flags are those of cv::imread().
cv::Mat decode(std::string_view bytes, int flags);

/// The bytes of a file with this suffix, such as ".png"; none if it cannot be encoded. Options are
/// those of cv::imwrite().
std::string encode(const std::string& suffix, const cv::Mat& image,
                   const std::vector<int>& options = {});

}  // namespace mtstereo::images
