// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>

#include "programs/calibrate/board.hpp"
#include "programs/calibrate/bundle.hpp"
#include "programs/calibrate/charuco.hpp"

namespace mtstereo::calibrate {

/// The corners in both views of a pair.
struct CornerPair {
  Corners left;
  Corners right;

  /// Both views have enough corners, and share enough of them.
  bool usable() const;
};

/// Finds a board in gray images. Images without the board give no corners; no image is an error.
class BoardFinder {
 public:
  explicit BoardFinder(const BoardOptions& options);

  /// The corners in one image.
  Corners find(const cv::Mat& gray) const;
  /// The corners in both views, which are searched at the same time.
  CornerPair find(const cv::Mat& left, const cv::Mat& right) const;

  /// The corners with their positions on the board.
  BoardView view_of(const CornerPair& pair) const;

 private:
  Corners find_checkerboard(const cv::Mat& gray) const;
  std::vector<Observation> observations(const Corners& corners) const;

  BoardOptions options_;
  std::vector<Eigen::Vector3d> points_;
  std::optional<CharucoFinder> charuco_;
};

/// Numbers the corners of a checkerboard in the right view as in the left one: the board looks the
/// same if it is turned by half a turn.
void match_numbers(const Corners& left, Corners& right);

}  // namespace mtstereo::calibrate
