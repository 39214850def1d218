// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace mtstereo::calibrate {

enum class BoardKind {
  kCharuco,       ///< a checkerboard with a marker in each white square; may be partly visible
  kCheckerboard,  ///< without markers; must be visible as a whole
};

/// What a board looks like.
struct BoardOptions {
  BoardKind kind = BoardKind::kCharuco;
  int columns = 9;                     ///< squares
  int rows = 6;                        ///< squares
  double square = 0.028;               ///< side of a square [m]
  double marker = 0;                   ///< side of a marker [m]; 0 = 3/4 of a square
  std::string dictionary = "4x4_100";  ///< of the markers

  /// The side of a marker [m].
  double marker_side() const { return marker > 0 ? marker : square * 3 / 4; }
};

/// The first invalid value as a sentence; empty if all are valid.
std::string check(const BoardOptions& options);

/// The board as the user describes it: "9x6 squares of 28 mm, ChArUco, markers of 21 mm, ...".
std::string describe(const BoardOptions& options);

/// The corners of the squares inside of the board, by their number [m]: x to the right, y
/// downwards, z = 0, from the upper left corner of the board.
std::vector<Eigen::Vector3d> corner_points(const BoardOptions& options);

/// What is black on the board [m].
std::vector<cv::Rect2d> black_rectangles(const BoardOptions& options);

/// The board as a gray picture, for renderers and tests: `scale` pixels per square and `border`
/// squares of white on each side.
cv::Mat board_picture(const BoardOptions& options, int scale, double border = 1);

}  // namespace mtstereo::calibrate
