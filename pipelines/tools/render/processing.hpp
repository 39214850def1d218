// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <opencv2/core.hpp>

namespace mtstereo::render {

/// What a camera with one color per pixel makes of its signal: Bayer mosaic, demosaicing, noise
/// reduction and sharpening. `signal` is CV_32FC3 (blue, green, red) with noise, 255 = white; so is
/// the result, and it may exceed 0 .. 255. `noise` is the standard deviation of the noise that the
/// camera expects [gray values].
cv::Mat through_mosaic(const cv::Mat& signal, double noise);

/// The mosaic alone: CV_16UC1, 256 * signal, clipped; rows of red and green alternate with those of
/// green and blue, and `margin` px repeat the border on each side.
cv::Mat mosaic_of(const cv::Mat& signal, int margin);

}  // namespace mtstereo::render
