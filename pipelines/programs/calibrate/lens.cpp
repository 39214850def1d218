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

constexpr int kCoefficients = kMostParameters - kPinholeParameters;
using ByCoefficients = Eigen::Matrix<double, 2, kCoefficients>;

// The derivatives of distort().
struct DistortionSlope {
  Eigen::Matrix2d by_ideal;
  ByCoefficients by_coefficients;
};

DistortionSlope distortion_slope(const Camera& camera, const Vector2d& ideal) {
  const auto& v = camera.values;
  const double k1 = v[4], k2 = v[5], p1 = v[6], p2 = v[7], k3 = v[8];
  const double k4 = v[9], k5 = v[10], k6 = v[11];
  const double x = ideal.x();
  const double y = ideal.y();
  const double r2 = x * x + y * y, r4 = r2 * r2, r6 = r4 * r2;
  const double below = 1 + r2 * (k4 + r2 * (k5 + r2 * k6));
  const double radial = (1 + r2 * (k1 + r2 * (k2 + r2 * k3))) / below;
  const double by_r2 =
      (k1 + r2 * (2 * k2 + r2 * 3 * k3) - radial * (k4 + r2 * (2 * k5 + r2 * 3 * k6))) / below;
  DistortionSlope slope;
  const double mixed = 2 * (x * y * by_r2 + p1 * x + p2 * y);
  slope.by_ideal << radial + 2 * (x * x * by_r2 + p1 * y + 3 * p2 * x), mixed,  //
      mixed, radial + 2 * (y * y * by_r2 + 3 * p1 * y + p2 * x);
  const Vector2d above = ideal / below, under = -radial * above;
  slope.by_coefficients << above * r2, above * r4, Vector2d(2 * x * y, r2 + 2 * y * y),
      Vector2d(r2 + 2 * x * x, 2 * x * y), above * r6, under * r2, under * r4, under * r6;
  return slope;
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

// Newton's method from the center side, with steps that stay where the image does not fold back.
std::optional<Vector3d> pinhole_ray(const Camera& camera, const Vector2d& distorted) {
  Vector2d ideal = distorted;
  if (!(distortion_slope(camera, ideal).by_ideal.determinant() > 0)) ideal.setZero();
  Vector2d miss = distort(camera, ideal) - distorted;
  for (int i = 0; i < kMostSteps && miss.norm() > kSmallStep; ++i) {
    Vector2d step = distortion_slope(camera, ideal).by_ideal.inverse() * miss;
    for (int half = 0;; ++half, step /= 2) {
      if (half == kMostSteps) return std::nullopt;
      const Vector2d trial = ideal - step;
      const Vector2d rest = distort(camera, trial) - distorted;
      const bool better = rest.norm() < miss.norm() || rest.norm() < kLargestMiss / 100;
      if (!better || !(distortion_slope(camera, trial).by_ideal.determinant() > 0)) continue;
      ideal = trial;
      miss = rest;
      break;
    }
  }
  if (!(miss.norm() <= kLargestMiss)) return std::nullopt;
  return Vector3d(ideal.x(), ideal.y(), 1).normalized();
}

// The derivatives of an image in units of the focal length.
struct LensSlope {
  Eigen::Matrix<double, 2, 3> by_point;
  ByCoefficients by_coefficients = ByCoefficients::Zero();
};

LensSlope slope_of_pinhole(const Camera& camera, const Vector3d& point) {
  const Vector2d ideal = point.head<2>() / point.z();
  const DistortionSlope distortion = distortion_slope(camera, ideal);
  Eigen::Matrix<double, 2, 3> ideal_by_point;
  ideal_by_point << Eigen::Matrix2d::Identity(), -ideal;
  return {distortion.by_ideal * ideal_by_point / point.z(), distortion.by_coefficients};
}

LensSlope slope_of_fisheye(const Camera& camera, const Vector3d& point) {
  LensSlope slope;
  const double side = point.head<2>().norm();
  if (side < kSmallStep) {
    slope.by_point << Eigen::Matrix2d::Identity() / point.z(), Vector2d::Zero();
    return slope;
  }
  const double angle = std::atan2(side, point.z());
  const double radius = fisheye_radius(camera, angle);
  const Vector2d outward = point.head<2>() / side;
  const Vector3d angle_by_point =
      Vector3d(outward.x() * point.z(), outward.y() * point.z(), -side) / point.squaredNorm();
  slope.by_point = outward * fisheye_slope(camera, angle) * angle_by_point.transpose();
  slope.by_point.leftCols<2>() +=
      radius / side * (Eigen::Matrix2d::Identity() - outward * outward.transpose());
  double power = angle;
  for (int i = 0; i < 4; ++i) {
    power *= angle * angle;
    slope.by_coefficients.col(i) = outward * power;
  }
  return slope;
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

std::optional<Projection> Camera::linearize(const Vector3d& point) const {
  const std::optional<Vector2d> pixel = project(point);
  if (!pixel) return std::nullopt;
  const LensSlope slope =
      model == Model::kFisheye ? slope_of_fisheye(*this, point) : slope_of_pinhole(*this, point);
  const Vector2d focal(values[0], values[1]);
  const Vector2d center(values[2], values[3]);
  Projection result;
  result.pixel = *pixel;
  result.by_point = focal.asDiagonal() * slope.by_point;
  result.by_values.col(0) << (pixel->x() - center.x()) / focal.x(), 0;
  result.by_values.col(1) << 0, (pixel->y() - center.y()) / focal.y();
  result.by_values.middleCols<2>(2).setIdentity();
  result.by_values.rightCols<kCoefficients>() = focal.asDiagonal() * slope.by_coefficients;
  return result;
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
