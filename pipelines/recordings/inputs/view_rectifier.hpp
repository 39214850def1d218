// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "mtstereo/geometry/rectification.hpp"

namespace mtstereo::run {

/// Rectifies gray images of one camera. They may be smaller than the frames that the calibration
/// is for.
class ViewRectifier {
 public:
  ViewRectifier(StereoCalibration calibration, Rectifier::Side side);

  /// The rectified image; an empty one stays empty. Throws UserError.
  cv::Mat apply(const cv::Mat& image);

 private:
  void prepare(cv::Size size);

  StereoCalibration calibration_;
  Rectifier::Side side_;
  cv::Size in_, out_;
  std::optional<Rectifier> rectifier_;
};

}  // namespace mtstereo::run
