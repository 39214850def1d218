// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <opencv2/core.hpp>

#include "programs/calibrate/calibrating.hpp"
#include "programs/calibrate/coverage.hpp"
#include "programs/calibrate/source.hpp"

// Images for the user. All are CV_8UC3.

namespace mtstereo::calibrate {

/// Both images of a pair with the corners that were found.
cv::Mat draw_views(const ImagePair& images, const CornerPair& corners);

/// The cells of both cameras' images, green where corners were, with all corners.
cv::Mat draw_coverage(const Coverage& coverage, const std::vector<BoardView>& views, cv::Size left,
                      cv::Size right);

/// Both images rectified, with lines along rows: the same point of the scene must be at the same
/// height on both sides. Empty if they cannot be rectified.
cv::Mat draw_rectified(const Calibrated& calibrated, const cv::Mat& left, const cv::Mat& right);

/// The residuals of all corners of both cameras, enlarged: a circle for each 0.5 px.
cv::Mat draw_residuals(const Solution& solution);

}  // namespace mtstereo::calibrate
