// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <opencv2/core.hpp>

#include "mtstereo/geometry/calibration.hpp"
#include "tools/render/settings.hpp"

namespace mtstereo::render {

class Lens;

/// A camera: a pinhole, or one with a lens.
struct Camera {
  double focal = 1;                   ///< of a pinhole [px]
  double center_x = 0, center_y = 0;  ///< principal point of a pinhole [px]
  Eigen::Isometry3d pose =            ///< transform from this camera to the left one
      Eigen::Isometry3d::Identity();
  std::shared_ptr<const Lens> lens{};  ///< replaces the pinhole, if there is one

  /// The ray through a point of the image in the camera's coordinates; its z is 1.
  Eigen::Vector3d direction(double x, double y) const;
  /// The point of the image that a ray with z > 0 in the camera's coordinates passes through.
  cv::Point2d project(const Eigen::Vector3d& direction) const;
  /// The point of the image where the camera sees a point, which is given in the axes of the left
  /// camera.
  cv::Point2d pixel_of(const Eigen::Vector3d& point) const;
};

/// The left camera of the settings. All functions below expect the settings of complete().
Camera left_camera(const Settings& settings);

/// The right camera of a rectified pair.
Camera ideal_right_camera(const Settings& settings);

/// The right camera with the errors of Settings::rig.
Camera right_camera(const Settings& settings);

/// Where the right camera sees what the ideal one sees at (x, y) [px]. The mapping is the same for
/// every depth; the row displacement at (x, y) is right_pixel(settings, x, y).y - y.
cv::Point2d right_pixel(const Settings& settings, double x, double y);

/// The inverse of right_pixel(): where the ideal right camera sees what the right one sees at
/// (x, y).
cv::Point2d ideal_pixel(const Settings& settings, double x, double y);

/// The rectified pair of the settings: what the ground truth of render() refers to.
Rectification rectification_of(const Settings& settings);

/// The cameras of a rectified pair. Their poses lead to the axes of the left camera before the
/// rectification.
Camera rectified_left_camera(const Rectification& rectification);
Camera rectified_right_camera(const Rectification& rectification);

}  // namespace mtstereo::render
