// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <opencv2/core.hpp>

#include "eval/curve_report.hpp"

namespace mtstereo::eval {

/// The picture of the curves (CV_8UC3, 1200x600): avgerr against density on the left, D-all on the
/// right, a legend above and what was run below.
cv::Mat draw_curves(const CurveReport& report);

/// The color of a method's lines (blue, green, red), by Curve::method: mtstereo's own is red.
cv::Scalar curve_color(std::size_t method);

/// Where the axes of the two panels run in the picture: density 0 .. 100 % from left to right.
cv::Rect panel_area(int panel);

}  // namespace mtstereo::eval
