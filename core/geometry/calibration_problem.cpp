// SPDX-License-Identifier: LGPL-2.1-or-later
#include "geometry/calibration_problem.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "mtstereo/parameters.hpp"

namespace mtstereo {
namespace {

constexpr int kSmallestSide = 2;  // [px]; bilinear interpolation needs two

bool all_finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

bool has_known_count(const CameraCalibration& camera) {
  const std::size_t count = camera.coefficients.size();
  switch (camera.lens) {
    case LensModel::kNone:
      return count == 0;
    case LensModel::kFisheye:
      return count == 4;
    case LensModel::kOmnidirectional:
      return count == 5;
    case LensModel::kPlumbBob:
      return count == 4 || count == 5 || count == 8 || count == 12 || count == 14;
  }
  return false;
}

}  // namespace

std::string camera_problem(const CameraCalibration& camera) {
  for (const int side : {camera.width, camera.height}) {
    if (side >= kSmallestSide && side <= kLargestImageSide) continue;
    return "states a size of " + std::to_string(camera.width) + "x" +
           std::to_string(camera.height) + " px; it must be " + std::to_string(kSmallestSide) +
           " to " + std::to_string(kLargestImageSide) + " px.";
  }
  if (!std::isfinite(camera.focal_x) || !std::isfinite(camera.focal_y) || camera.focal_x <= 0 ||
      camera.focal_y <= 0 || !std::isfinite(camera.center_x) || !std::isfinite(camera.center_y)) {
    return "states a focal length that is not positive, or a principal point that is not finite.";
  }
  if (!has_known_count(camera) || !all_finite(camera.coefficients)) {
    return "states " + std::to_string(camera.coefficients.size()) +
           " distortion coefficients; its lens model needs finite ones, 4 (fisheye), 5 "
           "(omnidirectional) or 4, 5, 8, 12 "
           "or 14 (polynomial).";
  }
  return {};
}

std::string pose_problem(const StereoCalibration& calibration) {
  const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> rotation(
      calibration.rotation.data());
  const Eigen::Map<const Eigen::Vector3d> translation(calibration.translation.data());
  constexpr double kTolerance = 1e-3;
  const double error = (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm();
  if (!(error < kTolerance) || !(rotation.determinant() > 0)) {
    return "The calibration states a matrix R that is no rotation.";
  }
  if (!translation.allFinite() || !(translation.norm() > 0)) {
    return "The calibration states a baseline of zero.";
  }
  return {};
}

}  // namespace mtstereo
