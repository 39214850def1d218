// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "mtstereo/geometry/calibration.hpp"
#include "recordings/inputs/recording.hpp"

namespace mtstereo::run {

/// The arrangement of two views that the shape of a frame suggests; none for the shape of one view.
std::optional<Arrangement> arrangement_by_shape(int width, int height);

/// How well the halves of frames match, as fractions of their corners.
struct HalvesMatch {
  double forward = 0;      ///< with the first half as the left view [0 .. 1]
  double backward = 0;     ///< with the second half as the left view [0 .. 1]
  bool confirmed = false;  ///< the halves are two views of a scene
  bool swapped = false;    ///< the first half is the right view
};

/// A half of a frame with both views, reduced to this width [px] if it is wider; a strip is reduced
/// less, to no less than one row. Empty if the frame has a single row or column to halve. `number`:
/// 0 or 1.
cv::Mat half_of(const cv::Mat& frame, Arrangement arrangement, int number, int width);

/// Matches the halves of gray frames with each other, in both orders. With a calibration, they are
/// rectified first. The order of views that are not rectified cannot be seen: they are not swapped.
/// Throws UserError.
HalvesMatch match_halves(const std::vector<cv::Mat>& frames, Arrangement arrangement,
                         const std::optional<StereoCalibration>& calibration);

}  // namespace mtstereo::run
