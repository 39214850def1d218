// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Core>
#include <numbers>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "mtstereo/geometry/calibration.hpp"

namespace mtstereo::render {

/// One degree [rad].
inline constexpr double kDegree = std::numbers::pi / 180;

/// The exact mapping between the pixels of a raw camera and the rays in its axes, in both
/// directions. The models and their coefficients are those of OpenCV.
class Lens {
 public:
  /// Throws std::invalid_argument if a setting of the camera is invalid, or if a ray of its image
  /// does not exist, is not unique, or is more than 85 degrees from the optical axis. The message
  /// begins with `name`, such as "the left camera".
  Lens(CameraCalibration camera, const std::string& name);

  /// The description of the camera.
  const CameraCalibration& camera() const { return camera_; }

  /// The ray through a point of the image, also up to 2 px outside of it [px]; its z is 1. Its
  /// error is below 1e-9 px.
  Eigen::Vector3d ray(double x, double y) const;

  /// Where the camera sees a point with z > 0 in its axes [px]. The polynomial model also maps
  /// points far outside of the field of view into the image; sees() excludes them.
  cv::Point2d pixel(const Eigen::Vector3d& point) const;

  /// Whether a point in the camera's axes is inside of the image, at least `margin` px from its
  /// border.
  bool sees(const Eigen::Vector3d& point, double margin = 0) const;

  /// The number of pixels per unit of area of the plane z = 1 around a ray whose z is 1.
  double magnification(const Eigen::Vector3d& ray) const;

 private:
  Eigen::Vector2d target(double x, double y) const;
  Eigen::Vector2d plane_point(const Eigen::Vector2d& target, double x, double y) const;
  double angle_of(double distance) const;
  void prepare_polynomial(const std::string& name);
  void prepare_fisheye(const std::string& name);

  CameraCalibration camera_;
  std::vector<double> k_;                                       // all 14 (or 4) coefficients
  Eigen::Matrix3d tilt_ = Eigen::Matrix3d::Identity();          // of the sensor
  Eigen::Matrix3d tilt_inverse_ = Eigen::Matrix3d::Identity();  // of the sensor
  double largest_angle_ = 0;           // of the fisheye's invertible range [rad]
  std::vector<Eigen::Vector2d> grid_;  // points of the plane z = 1 for a grid of pixels
};

}  // namespace mtstereo::render
