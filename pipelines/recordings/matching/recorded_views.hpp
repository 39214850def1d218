// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "recordings/clocks/gray_frames.hpp"
#include "recordings/matching/piece.hpp"

namespace mtstereo::run {

/// The views of a recording as gray images, by the numbers of their frames. They are as the
/// cameras deliver them: not rectified.
class RecordedViews {
 public:
  /// Images of at most this width [px]. The work must outlive the object. Throws UserError.
  RecordedViews(const Work& work, int width);

  /// Empty if the frame does not exist or cannot be decoded. Numbers that increase are fast.
  cv::Mat left(std::int64_t number);
  cv::Mat right(std::int64_t number);

 private:
  cv::Mat half(std::int64_t number, int side);

  const Recording& recording_;
  int width_;
  GrayFrames left_;
  std::optional<GrayFrames> right_;
};

/// The frames of a pair for RecordedViews.
FramePair frames_of(const Work& work, std::int64_t pair);

/// The calibration that rectifies the views; none: they are taken as they are. Throws UserError.
std::optional<StereoCalibration> rectifying_calibration(const Work& work);

}  // namespace mtstereo::run
