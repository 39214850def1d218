// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cameras/rectification_plan.hpp"

namespace mtstereo::plugin {

bool RectificationPlan::has_maps_of(const RectificationPlan& other) const {
  return settings.side == other.settings.side && camera() == other.camera() &&
         rectification == other.rectification;
}

Status CalibrationFile::read(const RectifySettings& settings, FrameSize size) {
  calibration_.reset();
  Result<StereoCalibration> calibration =
      read_calibration(settings.calibration, size.width, size.height);
  if (!calibration) return calibration.error();
  calibration_ = std::move(*calibration);
  path_ = settings.calibration;
  files_ = settings.files;
  read_for_ = size;
  return {};
}

Result<StereoCalibration> CalibrationFile::for_video(const RectifySettings& settings,
                                                     FrameSize size) {
  // Some formats state calibrations of several sizes, or none: the size of the video matters.
  const bool known = calibration_ && path_ == settings.calibration && files_ == settings.files &&
                     read_for_ == size;
  if (!known) {
    if (const Status status = read(settings, size); !status) return status.error();
  }
  const auto fits = [&](const CameraCalibration& camera) {
    return camera.width == size.width && camera.height == size.height;
  };
  if (fits(calibration_->left) && fits(calibration_->right)) return *calibration_;
  return scale_calibration(*calibration_, size.width, size.height);
}

std::optional<FrameSize> CalibrationFile::size_of(const RectifySettings& settings) {
  if (!read(settings, {})) return std::nullopt;
  const CameraCalibration& camera =
      settings.side == Rectifier::Side::kLeft ? calibration_->left : calibration_->right;
  if (camera.width < 1 || camera.height < 1) return std::nullopt;
  return FrameSize{camera.width, camera.height};
}

Result<RectificationPlan> plan_rectification(CalibrationFile& file, const RectifySettings& settings,
                                             FrameSize input, FrameSize output) {
  Result<StereoCalibration> calibration = file.for_video(settings, input);
  if (!calibration) return calibration.error();
  RectificationOptions options = settings.options;
  if (output != FrameSize{}) {
    options.width = output.width;
    options.height = output.height;
  }
  const Result<Rectification> rectification = rectify(*calibration, options);
  if (!rectification) return rectification.error();
  return RectificationPlan{settings, input, std::move(*calibration), *rectification};
}

}  // namespace mtstereo::plugin
