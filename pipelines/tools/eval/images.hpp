// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>

#include "tools/eval/datasets.hpp"

namespace mtstereo::eval {

/// Writes a disparity map (CV_32FC1 [px], NaN = none) as PFM, where infinity is none. Throws
/// UserError if the file cannot be written.
void write_disparity(const std::filesystem::path& file, const cv::Mat& disparity);

/// A disparity map in color (CV_8UC3): 0 .. max_disparity in the color map Turbo, near is red;
/// black = none. The range is fixed, so that the images of a run can be compared.
cv::Mat color_disparity(const cv::Mat& disparity, int max_disparity);

/// Errors from this on [px of the original images] have the last color of the error image.
inline constexpr double kErrorImageRange = 5;

/// The error in color (CV_8UC3): 0 .. kErrorImageRange px from dark blue to red (Turbo); gray =
/// ground truth without an estimate, black = no ground truth.
cv::Mat color_error(const cv::Mat& disparity, const GroundTruth& truth);

/// The left image and the ground truth above the disparity and the error, as one image.
cv::Mat overview(const LoadedPair& images, const cv::Mat& disparity, int max_disparity);

/// Writes an image as PNG, regardless of the extension. Throws UserError.
void write_image(const std::filesystem::path& file, const cv::Mat& image);

}  // namespace mtstereo::eval
