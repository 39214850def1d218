// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <opencv2/core.hpp>
#include <string>

namespace mtstereo::tests {

/// Sends one pair (CV_8UC1) through the element `mtstereo` with these properties, such as
/// "mode=sparse max-disparity=64", and returns its disparity in px (CV_32FC1, NaN = none), or an
/// empty image if the element gave no buffer.
cv::Mat match_with_element(const cv::Mat& left, const cv::Mat& right,
                           const std::string& properties);

}  // namespace mtstereo::tests
