// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "tools/eval/metrics.hpp"

namespace mtstereo::eval {

/// The number of frames that flicker is measured on.
inline constexpr int kFlickerFrames = 6;

/// How the disparity maps of an unmoving scene change from frame to frame.
struct Flicker {
  double density = kNone;      ///< mean share of all pixels with a disparity [%]
  double come_and_go = kNone;  ///< of the pixels with a disparity in any map: not in all maps [%]
  double spread = kNone;       ///< mean standard deviation of the pixels with one in all maps [px]
};

/// Compares disparity maps of the same size (CV_32FC1 [px], NaN = none). Throws UserError if the
/// sizes differ or there are fewer than two maps.
Flicker measure_flicker(const std::vector<cv::Mat>& maps);

/// The mean over pairs; a figure that is NaN is left out.
Flicker mean(const std::vector<Flicker>& list);

/// The views of frame 0 .. kFlickerFrames - 1: fresh Gaussian noise of this standard deviation
/// [gray values] in both views.
void add_flicker_noise(double sigma, int frame, cv::Mat& left, cv::Mat& right);

}  // namespace mtstereo::eval
