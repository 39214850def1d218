// SPDX-License-Identifier: LGPL-2.1-or-later
#include "geometry/lens.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace mtstereo {
namespace {

using Matrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
/// The tangent of the widest direction of a polynomial lens: 89.4 degrees.
constexpr double kLargestTangent = 100;
/// Steps of the search for the radius at which a model turns back.
constexpr int kLimitSteps = 2000;

/// Multiplies a row-major matrix by (x, y, 1) and divides by the third component.
std::array<double, 2> apply(const Matrix3& m, double x, double y) {
  const double w = m[6] * x + m[7] * y + m[8];
  return {(m[0] * x + m[1] * y + m[2]) / w, (m[3] * x + m[4] * y + m[5]) / w};
}

}  // namespace

Lens::Lens(const CameraCalibration& camera) : camera_(camera) {
  const std::size_t count = std::min(camera.coefficients.size(), k_.size());
  if (camera.lens != LensModel::kNone) {
    std::copy_n(camera.coefficients.begin(), count, k_.begin());
  }
  if (camera.lens == LensModel::kPlumbBob && (k_[12] != 0 || k_[13] != 0)) set_tilt(k_[12], k_[13]);
  if (camera.lens == LensModel::kOmnidirectional) {
    xi_ = k_[0];
    std::rotate(k_.begin(), k_.begin() + 1, k_.end());
    k_.back() = 0;
    camera_.focal_x *= 1 + xi_;
    camera_.focal_y *= 1 + xi_;
  }
  limit_ = largest_radius();
}

// The unified projection: a direction is a point of the unit sphere, which is seen from a point
// that is xi behind the center of the sphere. The half of the sphere that is seen ends at its
// outline, or where the plane through that point is reached.
Lens::Point Lens::on_plane(const Vector3& direction) const {
  const auto [x, y, z] = direction;
  const double length = std::hypot(x, y, z);
  if (!(z > -std::min(xi_, 1 / xi_) * length)) return {kNone, kNone};
  const double depth = z + xi_ * length;
  return {x / depth, y / depth};
}

Vector3 Lens::off_plane(const Point& point) const {
  const double r2 = point[0] * point[0] + point[1] * point[1];
  // 0 on the outline of the sphere, where rounding may make it negative.
  const double root = std::sqrt(std::max(0.0, 1 + (1 - xi_ * xi_) * r2));
  const double scale = (xi_ + root) / (1 + r2);
  return {scale * point[0], scale * point[1], scale - xi_};
}

// The sensor is not perpendicular to the optical axis: OpenCV's model of 14 coefficients.
void Lens::set_tilt(double x, double y) {
  Matrix about_x;
  about_x << 1, 0, 0, 0, std::cos(x), std::sin(x), 0, -std::sin(x), std::cos(x);
  Matrix about_y;
  about_y << std::cos(y), 0, -std::sin(y), 0, 1, 0, std::sin(y), 0, std::cos(y);
  const Matrix turn = about_y * about_x;
  Matrix to_plane;
  to_plane << turn(2, 2), 0, -turn(0, 2), 0, turn(2, 2), -turn(1, 2), 0, 0, 1;
  Eigen::Map<Matrix>(tilt_.data()) = to_plane * turn;
  tilted_ = true;
}

// The distorted radius of the radial part of the model. The radius is the tangent of the angle to
// the optical axis, or the angle itself for a fisheye lens.
double Lens::radial(double radius) const {
  const double r2 = radius * radius;
  if (camera_.lens == LensModel::kFisheye) {
    return radius * (1 + r2 * (k_[0] + r2 * (k_[1] + r2 * (k_[2] + r2 * k_[3]))));
  }
  return radius * (1 + r2 * (k_[0] + r2 * (k_[1] + r2 * k_[4]))) /
         (1 + r2 * (k_[5] + r2 * (k_[6] + r2 * k_[7])));
}

// The radius up to which the distorted radius grows with it.
double Lens::largest_radius() const {
  const bool fisheye = camera_.lens == LensModel::kFisheye;
  double widest = fisheye ? std::numbers::pi : kLargestTangent;
  if (xi_ > 1) widest = std::min(widest, 1 / std::sqrt(xi_ * xi_ - 1));
  if (camera_.lens == LensModel::kNone) return std::numeric_limits<double>::infinity();
  double before = 0;
  double last = 0;
  for (int i = 1; i <= kLimitSteps; ++i) {
    // Steps grow with the tangent: directions near the axis matter most.
    const double part = static_cast<double>(i) / kLimitSteps;
    const double radius = fisheye ? widest * part : widest * part * part;
    const double distorted = radial(radius);
    if (!(distorted > before)) return last;
    before = distorted;
    last = radius;
  }
  return widest;
}

double Lens::inverse_radial(double distorted) const {
  double low = 0;
  double high = std::min(limit_, kLargestTangent);
  if (distorted > radial(high)) return kNone;
  for (int i = 0; i < 200 && high - low > 1e-15 * high; ++i) {
    const double middle = (low + high) / 2;
    (radial(middle) < distorted ? low : high) = middle;
  }
  return (low + high) / 2;
}

Lens::Point Lens::distort(double x, double y) const {
  const double r2 = x * x + y * y;
  const double r4 = r2 * r2;
  const double factor = (1 + r2 * (k_[0] + r2 * (k_[1] + r2 * k_[4]))) /
                        (1 + r2 * (k_[5] + r2 * (k_[6] + r2 * k_[7])));
  const double xy = 2 * x * y;
  const double xd = x * factor + k_[2] * xy + k_[3] * (r2 + 2 * x * x) + k_[8] * r2 + k_[9] * r4;
  const double yd = y * factor + k_[2] * (r2 + 2 * y * y) + k_[3] * xy + k_[10] * r2 + k_[11] * r4;
  if (!tilted_) return {xd, yd};
  return apply(tilt_, xd, yd);
}

std::array<double, 2> Lens::project(const Vector3& direction) const {
  const auto [x, y, z] = direction;
  Point point{kNone, kNone};
  if (camera_.lens == LensModel::kFisheye) {
    const double radius = std::hypot(x, y);
    const double angle = std::atan2(radius, z);
    if (angle > limit_) return point;
    const double scale = radius > 0 ? radial(angle) / radius : 0;
    point = {x * scale, y * scale};
  } else if (camera_.lens == LensModel::kOmnidirectional) {
    const Point plane = on_plane(direction);
    if (!(std::hypot(plane[0], plane[1]) <= limit_)) return point;
    point = distort(plane[0], plane[1]);
  } else {
    if (!(z > 0) || std::hypot(x, y) > limit_ * z) return point;
    point = camera_.lens == LensModel::kNone ? Point{x / z, y / z} : distort(x / z, y / z);
  }
  return {camera_.focal_x * point[0] + camera_.center_x,
          camera_.focal_y * point[1] + camera_.center_y};
}

// Newton's method on distort(), from the solution of its radial part.
Lens::Point Lens::undistort(const Point& distorted) const {
  Point start = distorted;
  if (tilted_) {
    const Matrix inverse = Eigen::Map<const Matrix>(tilt_.data()).inverse();
    Matrix3 m{};
    Eigen::Map<Matrix>(m.data()) = inverse;
    start = apply(m, distorted[0], distorted[1]);
  }
  const double radius = std::hypot(start[0], start[1]);
  double inner = inverse_radial(radius);
  if (std::isnan(inner)) inner = std::min(limit_, kLargestTangent);
  const double scale = radius > 0 ? inner / radius : 1;
  double x = start[0] * scale;
  double y = start[1] * scale;
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 50; ++i) {
    const Point at = distort(x, y);
    const double ex = distorted[0] - at[0];
    const double ey = distorted[1] - at[1];
    if (std::hypot(ex, ey) < 1e-13) break;
    const Point right = distort(x + kStep, y);
    const Point below = distort(x, y + kStep);
    const double a = (right[0] - at[0]) / kStep;
    const double b = (below[0] - at[0]) / kStep;
    const double c = (right[1] - at[1]) / kStep;
    const double d = (below[1] - at[1]) / kStep;
    const double determinant = a * d - b * c;
    x += (d * ex - b * ey) / determinant;
    y += (a * ey - c * ex) / determinant;
  }
  const Point reached = distort(x, y);
  const double error = std::hypot(distorted[0] - reached[0], distorted[1] - reached[1]);
  // The limit applies to the radial part: the other terms may move a point a little beyond it.
  if (!(error < 1e-9) || std::hypot(x, y) > limit_) return {kNone, kNone};
  return {x, y};
}

Vector3 Lens::direction(double u, double v) const {
  const double x = (u - camera_.center_x) / camera_.focal_x;
  const double y = (v - camera_.center_y) / camera_.focal_y;
  Eigen::Vector3d ray(x, y, 1);
  if (camera_.lens == LensModel::kFisheye) {
    const double distorted = std::hypot(x, y);
    const double angle = inverse_radial(distorted);
    const double scale = distorted > 0 ? std::sin(angle) / distorted : 1;
    ray = {x * scale, y * scale, std::cos(angle)};
  } else if (camera_.lens == LensModel::kPlumbBob) {
    const Point point = undistort({x, y});
    ray = {point[0], point[1], 1};
  } else if (camera_.lens == LensModel::kOmnidirectional) {
    ray = Eigen::Vector3d(off_plane(undistort({x, y})).data());
  }
  // Eigen's normalize() leaves a vector as it is if its length is NaN.
  if (!ray.allFinite()) return {kNone, kNone, kNone};
  ray.normalize();
  return {ray[0], ray[1], ray[2]};
}

double Lens::widest_angle() const {
  if (camera_.lens == LensModel::kOmnidirectional) {
    const Vector3 ray = off_plane({limit_, 0});
    return std::atan2(ray[0], ray[2]);
  }
  return camera_.lens == LensModel::kFisheye ? limit_ : std::atan(limit_);
}

}  // namespace mtstereo
