// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>

namespace mtstereo::eval {

/// How a disparity map is written to a file.
enum class DisparityFormat {
  kPfm,    ///< 32-bit float, infinity = none, as Middlebury wants it
  kKitti,  ///< 16-bit PNG, px = value / 256, 0 = none
};

/// The extension of its files, with the dot.
const char* extension_of(DisparityFormat format);

/// Writes a disparity map (CV_32FC1 [px], NaN = none). Throws InputError where the file cannot be
/// written, and where a disparity does not fit into the format.
void write_disparity(const std::filesystem::path& file, const cv::Mat& disparity,
                     DisparityFormat format);

/// A disparity map in color (CV_8UC3): 0 .. max_disparity along the map TURBO, the near is red;
/// black = none. The range is fixed, so that the pictures of a run can be compared.
cv::Mat color_disparity(const cv::Mat& disparity, int max_disparity);

/// From this error on [px] the error picture shows its last color.
inline constexpr double kErrorPictureRange = 5;

/// The error in color (CV_8UC3): 0 .. kErrorPictureRange px from dark blue to red (TURBO); gray =
/// truth without an estimate, black = no truth.
cv::Mat color_error(const cv::Mat& disparity, const cv::Mat& truth);

/// Left image and truth above, disparity and error below, in one picture.
cv::Mat overview(const cv::Mat& left, const cv::Mat& disparity, const cv::Mat& truth,
                 int max_disparity);

/// Writes a picture as PNG, whatever the name ends with. Throws InputError.
void write_picture(const std::filesystem::path& file, const cv::Mat& picture);

}  // namespace mtstereo::eval
