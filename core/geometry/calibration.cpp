// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mtstereo/geometry/calibration.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "base/guard.hpp"
#include "geometry/calibration_checks.hpp"
#include "geometry/calibration_remarks.hpp"
#include "geometry/check_image.hpp"
#include "geometry/formats/value.hpp"
#include "mtstereo/parameters.hpp"

namespace mtstereo {
namespace {

using formats::number_text;

/// Shortest baseline that is not zero [m].
constexpr double kShortestBaseline = 1e-5;
/// Shortest focal length of a pinhole camera, as a part of the width: 173 degrees.
constexpr double kShortestFocal = 0.03;
/// How far R may be from a rotation.
constexpr double kRotationTolerance = 1e-3;
/// How much the baseline of the rectification may differ from the length of T.
constexpr double kBaselineTolerance = 0.05;
/// Largest angle between R and the rotation that the rectification implies, as the largest
/// difference of the elements: about 1 degree.
constexpr double kRectifiedTolerance = 0.02;

bool all_finite(const auto& values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

Eigen::Matrix3d to_eigen(const Matrix3& matrix) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(matrix.data());
}

/// A side of 0 is unknown; then the other one is, too.
std::string size_problem(int width, int height) {
  if (width == 0 && height == 0) return {};
  if (width >= 1 && height >= 1 && width <= kLargestImageSide && height <= kLargestImageSide) {
    return {};
  }
  return "has the size " + image_size_text(width, height) + ", 1x1 to " +
         image_size_text(kLargestImageSide, kLargestImageSide) + " is needed";
}

/// A center outside of the image belongs to another size. Rectified views, which have no
/// distortion, may be shifted by more.
bool is_center_plausible(double center, int side, LensModel lens) {
  const double outside = (lens == LensModel::kNone ? 0.5 : 0.05) * side;
  return side == 0 || (center > -outside && center < side + outside);
}

std::string stated_camera_problem(const CameraCalibration& camera) {
  std::string problem = size_problem(camera.width, camera.height);
  if (!problem.empty()) return problem;
  if (!std::isfinite(camera.focal_x) || !std::isfinite(camera.focal_y) || camera.focal_x <= 0 ||
      camera.focal_y <= 0) {
    return "has the focal lengths " + number_text(camera.focal_x) + " and " +
           number_text(camera.focal_y) + "; they must be positive";
  }
  const bool pinhole = camera.lens == LensModel::kNone || camera.lens == LensModel::kPlumbBob;
  if (pinhole && camera.focal_x < kShortestFocal * camera.width) {
    return "has the focal length " + number_text(camera.focal_x) + " px for an image of " +
           image_size_text(camera.width, camera.height) +
           ", which no lens has; it must be in px, not in mm or parts of the width (px = mm / "
           "size of a pixel in mm)";
  }
  if (!std::isfinite(camera.center_x) || !std::isfinite(camera.center_y)) {
    return "has a principal point that is not finite";
  }
  if (!is_center_plausible(camera.center_x, camera.width, camera.lens) ||
      !is_center_plausible(camera.center_y, camera.height, camera.lens)) {
    return "has the principal point (" + number_text(camera.center_x) + ", " +
           number_text(camera.center_y) + ") outside of its image of " +
           image_size_text(camera.width, camera.height) +
           "; K belongs to another image size. State that size in the file (image_size: [ WIDTH, "
           "HEIGHT ]), and the calibration is scaled";
  }
  if (!is_coefficient_count(camera.lens, camera.coefficients.size())) {
    return "has " + std::to_string(camera.coefficients.size()) + " coefficients, " +
           coefficient_counts(camera.lens) + " are needed";
  }
  if (!all_finite(camera.coefficients)) return "has a coefficient that is not finite";
  return {};
}

std::string rectification_problem(const Rectification& rectification,
                                  const StereoCalibration& calibration) {
  std::string problem = size_problem(rectification.width, rectification.height);
  if (problem.empty()) problem = rotation_problem(rectification.left_rotation);
  if (problem.empty()) problem = rotation_problem(rectification.right_rotation);
  if (!problem.empty()) return problem;
  if (!std::isfinite(rectification.focal_length) || rectification.focal_length <= 0) {
    return "has the focal length " + number_text(rectification.focal_length) +
           "; it must be positive";
  }
  if (!std::isfinite(rectification.left_center_x) || !std::isfinite(rectification.center_y) ||
      !std::isfinite(rectification.right_center_x)) {
    return "has a principal point that is not finite";
  }
  const double baseline = calibration.baseline();
  const double difference = std::abs(rectification.baseline - baseline);
  if (!std::isfinite(difference) || difference > kBaselineTolerance * baseline) {
    return "has the baseline " + number_text(rectification.baseline) + " m, T states " +
           number_text(baseline) + " m; their units or their cameras differ";
  }
  const Eigen::Matrix3d left_from_right = to_eigen(rectification.right_rotation) *
                                          to_eigen(calibration.rotation) *
                                          to_eigen(rectification.left_rotation).transpose();
  if (!left_from_right.isApprox(Eigen::Matrix3d::Identity(), kRectifiedTolerance)) {
    return "does not belong to R: R2 R must be R1";
  }
  return {};
}

/// Why a calibration cannot be used, or an empty text.
std::string calibration_problem(const StereoCalibration& calibration) {
  std::string problem = stated_camera_problem(calibration.left);
  if (!problem.empty()) return "the left camera " + problem;
  problem = stated_camera_problem(calibration.right);
  if (!problem.empty()) return "the right camera " + problem;
  if ((calibration.left.width == 0) != (calibration.right.width == 0)) {
    return "only one of the cameras has a size";
  }
  problem = rotation_problem(calibration.rotation);
  if (!problem.empty()) return "the rotation between the cameras " + problem;
  problem = translation_problem(calibration.translation);
  if (!problem.empty()) return "the cameras have " + problem;
  if (calibration.rotation[0] < 0) {
    return "the right camera is turned by more than 90 degrees against the left one; if one of "
           "them is mounted upside down, turn its images (videoflip) and calibrate again";
  }
  if (calibration.translation[0] > 0) {
    return "the right camera is " + number_text(calibration.translation[0]) +
           " m to the left of the left one: the views are swapped";
  }
  if (!calibration.rectification) return {};
  problem = rectification_problem(*calibration.rectification, calibration);
  return problem.empty() ? problem : "the rectification " + problem;
}

/// Scales one camera to a size of its own.
void scale_camera(CameraCalibration& camera, double x, double y) {
  camera.focal_x *= x;
  camera.focal_y *= y;
  // The center of the first pixel is at 0, its border at -0.5.
  camera.center_x = (camera.center_x + 0.5) * x - 0.5;
  camera.center_y = (camera.center_y + 0.5) * y - 0.5;
}

bool fits(const CameraCalibration& camera, int width, int height) {
  const double scale = static_cast<double>(width) / camera.width;
  return std::abs(camera.height * scale - height) <= 1;
}

/// What a video has whose aspect ratio is half or twice that of the calibration, or its inverse,
/// with remedies; "" for another one.
std::string halved_or_turned(const CameraCalibration& camera, int width, int height) {
  const bool wide = fits(camera, width, 2 * height);
  if (!wide && !fits(camera, 2 * width, height)) {
    const bool turned = fits(camera, height, width);
    return turned ? ": it is turned by 90 degrees (turn it back with videoflip), or" : "";
  }
  const std::string whole =
      wide ? image_size_text(width, 2 * height) : image_size_text(2 * width, height);
  return std::string(": it has both views ") + (wide ? "side by side" : "one above the other") +
         " (split it first, by mtsplit), or views that are squeezed to half of their " +
         (wide ? "height" : "width") + " (scale each to " + whole + "), or";
}

Error aspect_error(const CameraCalibration& camera, int width, int height) {
  const std::string cause = halved_or_turned(camera, width, height);
  return {ErrorCode::kInvalidCalibration,
          "the calibration is for images of " + image_size_text(camera.width, camera.height) +
              ", the video has " + image_size_text(width, height) + ": the aspect ratios differ" +
              (cause.empty() ? ", so" : cause) + " the camera crops; calibrate with this size"};
}

void scale_rectification(Rectification& rectification, const CameraCalibration& old_left, int width,
                         int height) {
  const double scale = static_cast<double>(width) / old_left.width;
  rectification.focal_length *= scale;
  for (double* center :
       {&rectification.left_center_x, &rectification.right_center_x, &rectification.center_y}) {
    *center = (*center + 0.5) * scale - 0.5;
  }
  const bool same =
      rectification.width == old_left.width && rectification.height == old_left.height;
  const auto scaled = [&](int side) {
    return std::clamp(static_cast<int>(std::lround(side * scale)), 1, kLargestImageSide);
  };
  rectification.width = same ? width : scaled(rectification.width);
  rectification.height = same ? height : scaled(rectification.height);
}

Result<StereoCalibration> scaled(StereoCalibration calibration, int width, int height) {
  if (const Status status = check_calibration(calibration); !status) return status.error();
  if (width < 1 || height < 1 || width > kLargestImageSide || height > kLargestImageSide) {
    return Error{ErrorCode::kInvalidCalibration,
                 "a calibration cannot be scaled to " + image_size_text(width, height)};
  }
  CameraCalibration& left = calibration.left;
  CameraCalibration& right = calibration.right;
  if (left.width == 0) {
    for (CameraCalibration* camera : {&left, &right}) {
      camera->width = width;
      camera->height = height;
    }
    if (calibration.rectification && calibration.rectification->width == 0) {
      calibration.rectification->width = width;
      calibration.rectification->height = height;
    }
    if (const Status status = check_calibration(calibration); !status) return status.error();
    note_centers(calibration);
    return calibration;
  }
  for (const CameraCalibration* camera : {&left, &right}) {
    if (!fits(*camera, width, height)) return aspect_error(*camera, width, height);
  }
  if (calibration.rectification) {
    scale_rectification(*calibration.rectification, left, width, height);
  }
  for (CameraCalibration* camera : {&left, &right}) {
    scale_camera(*camera, static_cast<double>(width) / camera->width,
                 static_cast<double>(height) / camera->height);
    camera->width = width;
    camera->height = height;
  }
  return calibration;
}

}  // namespace

bool is_coefficient_count(LensModel lens, std::size_t count) noexcept {
  switch (lens) {
    case LensModel::kNone:
      return count == 0;
    case LensModel::kPlumbBob:
      return count == 4 || count == 5 || count == 8 || count == 12 || count == 14;
    case LensModel::kFisheye:
      return count == 4;
    case LensModel::kOmnidirectional:
      return count == 5;
  }
  return false;
}

const char* coefficient_counts(LensModel lens) noexcept {
  switch (lens) {
    case LensModel::kNone:
      return "none";
    case LensModel::kPlumbBob:
      return "4, 5, 8, 12 or 14";
    case LensModel::kFisheye:
      return "4";
    case LensModel::kOmnidirectional:
      return "5";
  }
  return "none";
}

std::string rotation_problem(const Matrix3& matrix) {
  if (!all_finite(matrix)) return "is not finite";
  const Eigen::Matrix3d rotation = to_eigen(matrix);
  const Eigen::Matrix3d product = rotation * rotation.transpose() - Eigen::Matrix3d::Identity();
  const double deviation = product.cwiseAbs().maxCoeff();
  if (!(deviation <= kRotationTolerance)) {
    return "is not a rotation: its rows are not orthonormal, they differ by " +
           number_text(std::round(deviation * 1e4) / 1e4);
  }
  if (rotation.determinant() < 0) return "is not a rotation: its determinant is -1, it mirrors";
  return {};
}

std::string translation_problem(const Vector3& translation) {
  if (!all_finite(translation)) return "a baseline that is not finite";
  const double baseline = std::hypot(translation[0], translation[1], translation[2]);
  const std::string length = "a baseline of " + number_text(baseline) + " m";
  if (baseline < kShortestBaseline) return length + "; the cameras must be at different places";
  if (baseline > kLongestBaseline) {
    // Pairs of cameras are rarely closer than 4 cm; squares of boards have 1 to 10 cm.
    constexpr double kMillimeters = 40;
    return length + ", more than " + number_text(kLongestBaseline) + " m: the length is " +
           (baseline < kMillimeters ? "in centimeters, millimeters or squares of the board"
                                    : "most likely in millimeters");
  }
  if (std::abs(translation[1]) > std::abs(translation[0])) {
    return length + " that is vertical; only pairs side by side are supported";
  }
  return {};
}

double StereoCalibration::baseline() const noexcept {
  return std::hypot(translation[0], translation[1], translation[2]);
}

Status check_calibration(const StereoCalibration& calibration) noexcept {
  return guarded([&]() -> Status {
    std::string problem = calibration_problem(calibration);
    if (problem.empty()) return {};
    return Error{ErrorCode::kInvalidCalibration, std::move(problem)};
  });
}

Result<StereoCalibration> scale_calibration(const StereoCalibration& calibration, int width,
                                            int height) noexcept {
  return guarded([&]() -> Result<StereoCalibration> { return scaled(calibration, width, height); });
}

}  // namespace mtstereo
