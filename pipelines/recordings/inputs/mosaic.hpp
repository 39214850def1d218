// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <opencv2/core.hpp>

namespace mtstereo::run {

/// Whether a gray frame is the mosaic of a color camera (Bayer): its neighboring pixels have
/// different colors.
bool is_mosaic(const cv::Mat& frame);

}  // namespace mtstereo::run
