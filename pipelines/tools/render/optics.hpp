// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <opencv2/core.hpp>

namespace mtstereo::render {

/// The square of the distance of a pixel from the center of the image: 0 in the center, 1 in the
/// corners.
double rim_share(const cv::Size& size, int x, int y);

/// The light behind a lens whose blur is a Gaussian with the standard deviation `center` + `rim` *
/// rim_share() [px].
cv::Mat after_lens(const cv::Mat& light, double center, double rim);

}  // namespace mtstereo::render
