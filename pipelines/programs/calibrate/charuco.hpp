// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "programs/calibrate/board_options.hpp"

// Everything that depends on OpenCV's ArUco module. Its interface changed with OpenCV 4.7.

namespace mtstereo::calibrate {

/// The names of the dictionaries of markers.
std::vector<std::string> dictionary_names();

/// How many markers a dictionary has; 0 if there is no such dictionary.
int dictionary_size(const std::string& name);

/// What is black in the markers of a board [m].
std::vector<cv::Rect2d> marker_rectangles(const BoardOptions& options);

/// Corners of a board in an image.
struct Corners {
  std::vector<int> ids;             ///< numbers of the corners, each at most once
  std::vector<cv::Point2f> pixels;  ///< their positions [px]
  int markers = 0;                  ///< markers that were seen, also if no corner was found
};

/// Finds the corners of a ChArUco board.
class CharucoFinder {
 public:
  explicit CharucoFinder(const BoardOptions& options);
  ~CharucoFinder();
  CharucoFinder(CharucoFinder&&) noexcept;
  CharucoFinder& operator=(CharucoFinder&&) noexcept;

  /// The corners in a gray image. May throw cv::Exception.
  Corners find(const cv::Mat& gray) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace mtstereo::calibrate
