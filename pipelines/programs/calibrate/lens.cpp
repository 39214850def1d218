// SPDX-License-Identifier: LGPL-2.1-or-later
#include "programs/calibrate/lens.hpp"

#include <algorithm>
#include <cmath>

namespace mtstereo::calibrate {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kNearestDepth = 1e-6;  // of points that a pinhole model can project
constexpr int kMostSteps = 30;
constexpr double kSmallStep = 1e-12;
// A solution of the inverse must project to the pixel again, to this part of the focal length.
constexpr double kLargestMiss = 1e-6;

// The distorted point of an ideal one, both in units of the focal length.
Vector2d distort(const Camera& camera, const Vector2d& ideal) {
  const auto& v = camera.values;
  const double k1 = v[4], k2 = v[5], p1 = v[6], p2 = v[7], k3 = v[8];
  const double k4 = v[9], k5 = v[10], k6 = v[11];  // 0 in the plumb bob model
  const double x = ideal.x();
  const double y = ideal.y();
  const double r2 = x * x + y * y;
  const double radial =
      (1 + r2 * (k1 + r2 * (k2 + r2 * k3))) / (1 + r2 * (k4 + r2 * (k5 + r2 * k6)));
  return {x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
          y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
}

// The distance from the center, in units of the focal length, of a ray at this angle to the axis.
double fisheye_radius(const Camera& camera, double angle) {
  const auto& v = camera.values;
  const double t2 = angle * angle;
  return angle * (1 + t2 * (v[4] + t2 * (v[5] + t2 * (v[6] + t2 * v[7]))));
}

double fisheye_slope(const Camera& camera, double angle) {
  const auto& v = camera.values;
  const double t2 = angle * angle;
  return 1 + t2 * (3 * v[4] + t2 * (5 * v[5] + t2 * (7 * v[6] + t2 * 9 * v[7])));
}

std::optional<Vector3d> fisheye_ray(const Camera& camera, const Vector2d& distorted) {
  const double radius = distorted.norm();
  if (radius < kSmallStep) return Vector3d::UnitZ();
  double angle = std::min(radius, 0.99 * M_PI);
  for (int i = 0; i < kMostSteps; ++i) {
    const double slope = fisheye_slope(camera, angle);
    if (slope <= 0) return std::nullopt;
    const double step = (fisheye_radius(camera, angle) - radius) / slope;
    angle = std::clamp(angle - step, 0.0, M_PI);
    if (std::abs(step) < kSmallStep) break;
  }
  if (std::abs(fisheye_radius(camera, angle) - radius) > kLargestMiss) return std::nullopt;
  const Vector2d side = distorted / radius * std::sin(angle);
  return Vector3d(side.x(), side.y(), std::cos(angle));
}

// The derivative of distort().
Eigen::Matrix2d distortion_slope(const Camera& camera, const Vector2d& ideal) {
  constexpr double kStep = 1e-7;
  Eigen::Matrix2d slope;
  for (int axis = 0; axis < 2; ++axis) {
    const Vector2d shift = kStep * Vector2d::Unit(axis);
    slope.col(axis) =
        (distort(camera, ideal + shift) - distort(camera, ideal - shift)) / (2 * kStep);
  }
  return slope;
}

// Newton's method from the center side, with steps that stay where the image does not fold back.
std::optional<Vector3d> pinhole_ray(const Camera& camera, const Vector2d& distorted) {
  Vector2d ideal = distorted;
  if (!(distortion_slope(camera, ideal).determinant() > 0)) ideal.setZero();
  Vector2d miss = distort(camera, ideal) - distorted;
  for (int i = 0; i < kMostSteps && miss.norm() > kSmallStep; ++i) {
    Vector2d step = distortion_slope(camera, ideal).inverse() * miss;
    for (int half = 0;; ++half, step /= 2) {
      if (half == kMostSteps) return std::nullopt;
      const Vector2d trial = ideal - step;
      const Vector2d rest = distort(camera, trial) - distorted;
      const bool better = rest.norm() < miss.norm() || rest.norm() < kLargestMiss / 100;
      if (!better || !(distortion_slope(camera, trial).determinant() > 0)) continue;
      ideal = trial;
      miss = rest;
      break;
    }
  }
  if (!(miss.norm() <= kLargestMiss)) return std::nullopt;
  return Vector3d(ideal.x(), ideal.y(), 1).normalized();
}

CameraCalibration calibration_of(const Camera& camera) {
  CameraCalibration result;
  result.width = camera.width;
  result.height = camera.height;
  result.focal_x = camera.values[0];
  result.focal_y = camera.values[1];
  result.center_x = camera.values[2];
  result.center_y = camera.values[3];
  result.lens = camera.model == Model::kFisheye ? LensModel::kFisheye : LensModel::kPlumbBob;
  result.coefficients.assign(camera.values.begin() + kPinholeParameters,
                             camera.values.begin() + parameter_count(camera.model));
  return result;
}

}  // namespace

const char* model_name(Model model) {
  switch (model) {
    case Model::kPlumbBob:
      return "plumb-bob";
    case Model::kRational:
      return "rational";
    case Model::kFisheye:
      break;
  }
  return "fisheye";
}

int parameter_count(Model model) {
  switch (model) {
    case Model::kPlumbBob:
      return 9;
    case Model::kRational:
      return 12;
    case Model::kFisheye:
      break;
  }
  return 8;
}

std::optional<Vector2d> Camera::project(const Vector3d& point) const {
  Vector2d distorted;
  if (model == Model::kFisheye) {
    const double side = std::hypot(point.x(), point.y());
    const double angle = std::atan2(side, point.z());
    if (side < kSmallStep) {
      if (point.z() <= 0) return std::nullopt;
      distorted.setZero();
    } else {
      distorted = point.head<2>() * (fisheye_radius(*this, angle) / side);
    }
  } else {
    if (point.z() < kNearestDepth) return std::nullopt;
    distorted = distort(*this, point.head<2>() / point.z());
  }
  return Vector2d(values[0] * distorted.x() + values[2], values[1] * distorted.y() + values[3]);
}

std::optional<Vector3d> Camera::ray(const Vector2d& pixel) const {
  const Vector2d distorted((pixel.x() - values[2]) / values[0],
                           (pixel.y() - values[3]) / values[1]);
  return model == Model::kFisheye ? fisheye_ray(*this, distorted) : pinhole_ray(*this, distorted);
}

Camera ideal_camera(Model model, int width, int height, double focal) {
  Camera camera;
  camera.model = model;
  camera.width = width;
  camera.height = height;
  camera.values[0] = camera.values[1] = focal;
  camera.values[2] = (width - 1) / 2.0;
  camera.values[3] = (height - 1) / 2.0;
  return camera;
}

Pose Pose::moved(const Eigen::Matrix<double, 6, 1>& step) const {
  const Vector3d turn = step.head<3>();
  const double angle = turn.norm();
  Pose result = *this;
  if (angle > 0) {
    result.rotation = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() * rotation;
  }
  result.translation += step.tail<3>();
  return result;
}

StereoCalibration calibration_of(const Rig& rig) {
  StereoCalibration result;
  result.left = calibration_of(rig.left);
  result.right = calibration_of(rig.right);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      const int index = 3 * row + column;
      result.rotation[static_cast<std::size_t>(index)] = rig.right_from_left.rotation(row, column);
    }
    result.translation[static_cast<std::size_t>(row)] = rig.right_from_left.translation(row);
  }
  return result;
}

}  // namespace mtstereo::calibrate
