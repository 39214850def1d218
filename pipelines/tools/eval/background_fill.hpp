// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <opencv2/core.hpp>

namespace mtstereo::eval {

/// Fills the gaps of a disparity map (CV_32FC1 [px], NaN = none) as the development kit of KITTI
/// does before it counts: a gap of a row gets the smaller disparity of its two sides, which is the
/// background, or that of its only side at the border. Rows without a disparity above the first or
/// below the last one with any copy that row; others of them stay without.
cv::Mat fill_background(const cv::Mat& disparity);

}  // namespace mtstereo::eval
