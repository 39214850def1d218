// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "programs/calibrate/board_options.hpp"

namespace mtstereo::calibrate {

/// The first invalid value as a sentence; empty if all are valid.
std::string check(const BoardOptions& options);

/// The board as the user describes it: "9x6 squares of 28 mm, ChArUco, markers of 21 mm, ...".
std::string describe(const BoardOptions& options);

/// The corners of the squares inside of the board, by their number [m]: x to the right, y
/// downwards, z = 0, from the upper left corner of the board.
std::vector<Eigen::Vector3d> corner_points(const BoardOptions& options);

/// What is black on the board [m].
std::vector<cv::Rect2d> black_rectangles(const BoardOptions& options);

/// The board as a gray image, for renderers and tests: `scale` pixels per square and `border`
/// squares of white on each side.
cv::Mat board_image(const BoardOptions& options, int scale, double border = 1);

}  // namespace mtstereo::calibrate
