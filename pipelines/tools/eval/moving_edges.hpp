// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "tools/eval/metrics.hpp"

namespace mtstereo::eval {

/// How good a disparity map of a stream is at the edges of objects, where a filter over time leaves
/// trails.
struct EdgeErrors {
  double wrong = kNone;  ///< of the known pixels at edges: errors above 3 px [%]
  /// Of the same: wrong, but within 1 px of what was true at the pixel in an earlier frame [%]. A
  /// map without memory has some by chance.
  double stale = kNone;
  double age = kNone;  ///< mean age of the stale disparities [frames]
};

/// CV_8UC1, nonzero = at an edge: the true disparity (CV_32FC1 [px], NaN = unknown) jumps by more
/// than 2 px within 5 px.
cv::Mat find_edges(const cv::Mat& truth);

/// Measures a map (CV_32FC1 [px], NaN = unknown). `truths` are those of the frames up to the map's,
/// of the same size; the last one has the edges. `scale`: see GroundTruth.
EdgeErrors measure_edges(const cv::Mat& map, const std::vector<cv::Mat>& truths, double scale = 1);

}  // namespace mtstereo::eval
