// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace mtstereo::eval {

/// The side of the window that count_flat_answers() looks at [px].
inline constexpr int kFlatWindow = 5;

/// The number of disparities that no image content supports: the kFlatWindow x kFlatWindow windows
/// around the left pixel (x, y) and around its right pixel (round(x - disparity), y) are both
/// constant. Windows end at the image border; a right pixel outside the image is not counted. The
/// disparity is CV_32FC1 [px], NaN = none; the images are CV_8UC1 of the same size. Throws
/// UserError if the sizes differ.
std::int64_t count_flat_answers(const cv::Mat& disparity, const cv::Mat& left,
                                const cv::Mat& right);

}  // namespace mtstereo::eval
