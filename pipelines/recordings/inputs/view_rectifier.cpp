// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/inputs/view_rectifier.hpp"

#include <utility>

#include "lib/outputs/user_error.hpp"

namespace mtstereo::run {
namespace {

template <typename T>
T value_of(Result<T> result) {
  if (!result) throw UserError("the views cannot be rectified: " + result.error().message);
  return std::move(*result);
}

}  // namespace

std::optional<StereoCalibration> rectifying_calibration(const Recording& recording, int width,
                                                        int height) {
  if (recording.rectified || recording.calibration.empty()) return std::nullopt;
  auto calibration = read_calibration(recording.calibration, width, height);
  if (!calibration) throw UserError(calibration.error().message);
  return std::move(*calibration);
}

ViewRectifier::ViewRectifier(StereoCalibration calibration, Rectifier::Side side)
    : calibration_(std::move(calibration)), side_(side) {}

void ViewRectifier::prepare(cv::Size size) {
  if (rectifier_ && size == in_) return;
  const StereoCalibration scaled =
      value_of(scale_calibration(calibration_, size.width, size.height));
  const Rectification rectification = value_of(rectify(scaled));
  rectifier_ = value_of(Rectifier::create(scaled, rectification, side_));
  in_ = size;
  out_ = {rectification.width, rectification.height};
}

cv::Mat ViewRectifier::apply(const cv::Mat& image) {
  if (image.empty()) return image;
  prepare(image.size());
  cv::Mat result(out_, CV_8UC1);
  const Status status = rectifier_->apply(
      {image.data, image.cols, image.rows, static_cast<std::ptrdiff_t>(image.step)},
      {result.data, result.cols, result.rows, static_cast<std::ptrdiff_t>(result.step)});
  if (!status) throw UserError("the views cannot be rectified: " + status.error().message);
  return result;
}

}  // namespace mtstereo::run
