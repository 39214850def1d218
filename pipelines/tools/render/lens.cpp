// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/render/lens.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace mtstereo::render {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kLargestAngle = 85 * kDegree;  // from the optical axis [rad]
constexpr int kGrid = 33;                       // starting points of the inversion: kGrid x kGrid
constexpr double kRim = 2;  // the inversion is valid up to here outside of the image [px]
constexpr int kMostSteps = 30;

struct Distorted {
  Vector2d point;
  Matrix2d jacobian;
};

// OpenCV's polynomial model without the tilt of the sensor, at a point of the plane z = 1.
Distorted distort(const std::vector<double>& k, const Vector2d& p) {
  const double x = p.x(), y = p.y(), r2 = p.squaredNorm();
  const double above = 1 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
  const double below = 1 + r2 * (k[5] + r2 * (k[6] + r2 * k[7]));
  const double radial = above / below;
  // Derivatives by r2.
  const double above_slope = k[0] + r2 * (2 * k[1] + r2 * 3 * k[4]);
  const double below_slope = k[5] + r2 * (2 * k[6] + r2 * 3 * k[7]);
  const double slope = (above_slope - radial * below_slope) / below;
  const double prism_x = k[8] + 2 * k[9] * r2, prism_y = k[10] + 2 * k[11] * r2;
  const double p1 = k[2], p2 = k[3];

  Distorted result;
  result.point.x() = x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x) + r2 * (k[8] + k[9] * r2);
  result.point.y() =
      y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y + r2 * (k[10] + k[11] * r2);
  const double mixed = 2 * x * y * slope + 2 * p1 * x + 2 * p2 * y;
  result.jacobian(0, 0) = radial + 2 * x * x * slope + 2 * p1 * y + 6 * p2 * x + 2 * x * prism_x;
  result.jacobian(0, 1) = mixed + 2 * y * prism_x;
  result.jacobian(1, 0) = mixed + 2 * x * prism_y;
  result.jacobian(1, 1) = radial + 2 * y * y * slope + 6 * p1 * y + 2 * p2 * x + 2 * y * prism_y;
  return result;
}

// The point of the plane z = 1 that is distorted to the target, by Newton's method; none if it does
// not converge.
std::optional<Vector2d> undistort(const std::vector<double>& k, const Vector2d& target,
                                  Vector2d at) {
  for (int step = 0; step < kMostSteps; ++step) {
    const Distorted here = distort(k, at);
    const Vector2d error = here.point - target;
    const double determinant = here.jacobian.determinant();
    if (!(determinant > 0)) return std::nullopt;  // also for NaN
    const Matrix2d& j = here.jacobian;
    const Vector2d move = Vector2d(j(1, 1) * error.x() - j(0, 1) * error.y(),
                                   j(0, 0) * error.y() - j(1, 0) * error.x()) /
                          determinant;
    at -= move;
    // The error after this step is about the square of the move.
    if (move.squaredNorm() < 1e-18 * (1 + at.squaredNorm())) return at;
  }
  return std::nullopt;
}

double fisheye_distance(const std::vector<double>& k, double angle) {
  const double a2 = angle * angle;
  return angle * (1 + a2 * (k[0] + a2 * (k[1] + a2 * (k[2] + a2 * k[3]))));
}

double fisheye_slope(const std::vector<double>& k, double angle) {
  const double a2 = angle * angle;
  return 1 + a2 * (3 * k[0] + a2 * (5 * k[1] + a2 * (7 * k[2] + a2 * 9 * k[3])));
}

// The projection from the plane of the lens to that of a sensor that is tilted by tx and ty.
Matrix3d tilt_of(double tx, double ty) {
  Matrix3d about_x, about_y;
  about_x << 1, 0, 0, 0, std::cos(tx), std::sin(tx), 0, -std::sin(tx), std::cos(tx);
  about_y << std::cos(ty), 0, -std::sin(ty), 0, 1, 0, std::sin(ty), 0, std::cos(ty);
  const Matrix3d turned = about_y * about_x;
  Matrix3d projection;
  projection << turned(2, 2), 0, -turned(0, 2), 0, turned(2, 2), -turned(1, 2), 0, 0, 1;
  return projection * turned;
}

[[noreturn]] void refuse(const std::string& name, const std::string& reason) {
  throw std::invalid_argument(name + ": " + reason);
}

[[noreturn]] void refuse_inversion(const std::string& name, double x, double y) {
  std::ostringstream text;
  text << "the distortion cannot be inverted at the pixel (" << x << ", " << y
       << "); check the distortion coefficients and the focal lengths";
  refuse(name, text.str());
}

[[noreturn]] void refuse_angle(const std::string& name) {
  refuse(name,
         "the image covers directions more than 85 degrees from the optical axis; use a "
         "longer focal length or a smaller image");
}

std::size_t coefficients_of(LensModel model) {
  return model == LensModel::kFisheye ? 4 : model == LensModel::kPlumbBob ? 14 : 0;
}

void check_camera(const CameraCalibration& c, const std::string& name) {
  const auto check = [&name](bool valid, const char* reason) {
    if (!valid) refuse(name, reason);
  };
  const auto positive = [](double v) { return std::isfinite(v) && v > 0; };
  check(c.width >= 1 && c.width <= 16384, "width must be 1 to 16384 px");
  check(c.height >= 1 && c.height <= 16384, "height must be 1 to 16384 px");
  check(positive(c.focal_x) && positive(c.focal_y), "the focal lengths must be positive");
  check(std::isfinite(c.center_x) && std::isfinite(c.center_y),
        "the principal point must be finite");
  check(std::all_of(c.coefficients.begin(), c.coefficients.end(),
                    [](double v) { return std::isfinite(v); }),
        "the distortion coefficients must be finite");
  const std::size_t count = c.coefficients.size();
  check(c.lens != LensModel::kOmnidirectional, "omnidirectional lenses are not rendered");
  if (c.lens == LensModel::kNone) check(count == 0, "a pinhole has no distortion coefficients");
  if (c.lens == LensModel::kFisheye) check(count == 4, "a fisheye has 4 distortion coefficients");
  if (c.lens == LensModel::kPlumbBob) {
    constexpr std::array<std::size_t, 5> kCounts = {4, 5, 8, 12, 14};
    check(std::find(kCounts.begin(), kCounts.end(), count) != kCounts.end(),
          "a plumb-bob lens has 4, 5, 8, 12 or 14 distortion coefficients");
  }
}

}  // namespace

Lens::Lens(CameraCalibration camera, const std::string& name) : camera_(std::move(camera)) {
  check_camera(camera_, name);
  k_ = camera_.coefficients;
  k_.resize(std::max<std::size_t>(coefficients_of(camera_.lens), 14));
  if (camera_.lens == LensModel::kFisheye) {
    prepare_fisheye(name);
  } else {
    if (k_[12] != 0 || k_[13] != 0) tilt_ = tilt_of(k_[12], k_[13]);
    if (!(std::abs(tilt_.determinant()) > 1e-6)) refuse(name, "the sensor is tilted too much");
    tilt_inverse_ = tilt_.inverse();
    prepare_polynomial(name);
  }
}

// The distortion is the identity at the principal point nearly; from there, each node of the grid
// is reached in small steps on which the Jacobian stays positive. So the inverse is unique.
void Lens::prepare_polynomial(const std::string& name) {
  constexpr int kSteps = 32;
  const double farthest = std::tan(kLargestAngle);
  grid_.reserve(kGrid * kGrid);
  for (int j = 0; j < kGrid; ++j) {
    for (int i = 0; i < kGrid; ++i) {
      const double x = -kRim + (camera_.width - 1 + 2 * kRim) * i / (kGrid - 1);
      const double y = -kRim + (camera_.height - 1 + 2 * kRim) * j / (kGrid - 1);
      Vector2d at = Vector2d::Zero();
      for (int step = 1; step <= kSteps; ++step) {
        const double along = static_cast<double>(step) / kSteps;
        const Vector2d aim = target(camera_.center_x + along * (x - camera_.center_x),
                                    camera_.center_y + along * (y - camera_.center_y));
        const auto next = undistort(k_, aim, at);
        if (!next) refuse_inversion(name, x, y);
        at = *next;
      }
      if (at.norm() > farthest) refuse_angle(name);
      grid_.push_back(at);
    }
  }
}

void Lens::prepare_fisheye(const std::string& name) {
  constexpr double kStep = kLargestAngle / 2000;
  double needed = 0, far_x = 0, far_y = 0;
  for (const double x : {-kRim, camera_.width - 1 + kRim}) {
    for (const double y : {-kRim, camera_.height - 1 + kRim}) {
      const double distance = target(x, y).norm();
      if (distance > needed) needed = distance, far_x = x, far_y = y;
    }
  }
  for (int step = 1; fisheye_distance(k_, largest_angle_) <= needed; ++step) {
    largest_angle_ = step * kStep;
    if (largest_angle_ > kLargestAngle) refuse_angle(name);
    if (!(fisheye_slope(k_, largest_angle_) > 0)) refuse_inversion(name, far_x, far_y);
  }
}

// The distorted point of the plane z = 1 that belongs to a pixel.
Vector2d Lens::target(double x, double y) const {
  const Vector2d p((x - camera_.center_x) / camera_.focal_x,
                   (y - camera_.center_y) / camera_.focal_y);
  if (camera_.lens == LensModel::kFisheye) return p;
  return (tilt_inverse_ * p.homogeneous()).hnormalized();
}

// The point of the plane z = 1 for a distorted point; (x, y) is its pixel, which selects the
// starting point.
Vector2d Lens::plane_point(const Vector2d& target, double x, double y) const {
  const double column =
      std::clamp((x + kRim) / (camera_.width - 1 + 2 * kRim), 0.0, 1.0) * (kGrid - 1);
  const double row =
      std::clamp((y + kRim) / (camera_.height - 1 + 2 * kRim), 0.0, 1.0) * (kGrid - 1);
  const int i = std::min(static_cast<int>(column), kGrid - 2);
  const int j = std::min(static_cast<int>(row), kGrid - 2);
  const double u = column - i, v = row - j;
  const Vector2d* node = &grid_[static_cast<std::size_t>(j) * kGrid + static_cast<std::size_t>(i)];
  const Vector2d start = (1 - v) * ((1 - u) * node[0] + u * node[1]) +
                         v * ((1 - u) * node[kGrid] + u * node[kGrid + 1]);
  const auto found = undistort(k_, target, start);
  if (!found) refuse_inversion("the lens", x, y);
  return *found;
}

// The angle from the optical axis whose distorted distance from the principal point is `distance`:
// Newton's method, kept inside of a shrinking interval.
double Lens::angle_of(double distance) const {
  double low = 0, high = largest_angle_;
  double angle = std::min(distance, high);
  for (int step = 0; step < 100; ++step) {
    const double error = fisheye_distance(k_, angle) - distance;
    (error > 0 ? high : low) = angle;
    double next = angle - error / fisheye_slope(k_, angle);
    if (!(next >= low && next <= high)) next = (low + high) / 2;
    const double move = std::abs(next - angle);
    angle = next;
    if (move < 1e-15) break;
  }
  return angle;
}

Vector3d Lens::ray(double x, double y) const {
  const Vector2d distorted = target(x, y);
  if (camera_.lens == LensModel::kNone) return distorted.homogeneous();
  if (camera_.lens == LensModel::kPlumbBob) return plane_point(distorted, x, y).homogeneous();
  const double distance = distorted.norm();
  if (distance < 1e-12) return distorted.homogeneous();
  return (std::tan(angle_of(distance)) / distance * distorted).homogeneous();
}

cv::Point2d Lens::pixel(const Vector3d& point) const {
  Vector2d p = point.hnormalized();
  if (camera_.lens == LensModel::kPlumbBob) {
    p = (tilt_ * distort(k_, p).point.homogeneous()).hnormalized();
  } else if (camera_.lens == LensModel::kFisheye) {
    const double radius = p.norm();
    if (radius > 1e-12) p *= fisheye_distance(k_, std::atan(radius)) / radius;
  }
  return {camera_.focal_x * p.x() + camera_.center_x, camera_.focal_y * p.y() + camera_.center_y};
}

bool Lens::sees(const Vector3d& point, double margin) const {
  if (!(point.z() > 0)) return false;
  const cv::Point2d at = pixel(point);
  const bool inside = at.x >= margin && at.x <= camera_.width - 1 - margin && at.y >= margin &&
                      at.y <= camera_.height - 1 - margin;
  if (!inside) return false;
  const Vector2d seen = point.hnormalized();
  return (ray(at.x, at.y).head<2>() - seen).norm() < 1e-6 * (1 + seen.norm());
}

double Lens::magnification(const Vector3d& ray) const {
  const double focal = camera_.focal_x * camera_.focal_y;
  if (camera_.lens == LensModel::kNone) return focal;
  if (camera_.lens == LensModel::kPlumbBob) {
    return focal * distort(k_, ray.head<2>()).jacobian.determinant();
  }
  const double radius = ray.head<2>().norm(), angle = std::atan(radius);
  if (radius < 1e-9) return focal;
  const double along = fisheye_slope(k_, angle) / (1 + radius * radius);
  const double across = fisheye_distance(k_, angle) / radius;
  return focal * along * across;
}

}  // namespace mtstereo::render
