// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <opencv2/core.hpp>

#include "tools/eval/metrics.hpp"

namespace mtstereo::eval {

/// CV_8UC1, nonzero = at an edge: the true disparity (CV_32FC1 [px], NaN = unknown) jumps by more
/// than 2 px within 5 px.
cv::Mat find_edges(const cv::Mat& truth);

/// Of the known pixels of a map (CV_32FC1 [px], NaN = unknown) at edges, where a filter over time
/// leaves trails: errors above 3 px [%]; kNone if there are none. `scale`: see GroundTruth.
double wrong_at_edges(const cv::Mat& map, const cv::Mat& truth, double scale = 1);

}  // namespace mtstereo::eval
