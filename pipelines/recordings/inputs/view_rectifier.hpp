// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "mtstereo/geometry/rectification.hpp"
#include "recordings/inputs/recording.hpp"

namespace mtstereo::run {

/// The calibration that rectifies the views of a recording, for views of this size [px]; none: they
/// are taken as they are. Throws UserError.
std::optional<StereoCalibration> rectifying_calibration(const Recording& recording, int width,
                                                        int height);

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
