// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

namespace mtstereo::render {

struct Settings;

/// The error of the right camera in a rig that is out of line. The camera's position is exact. The
/// defaults are a rectified pair.
struct Rig {
  double roll = 0;         ///< clockwise, seen from behind the camera [degrees]
  double pitch = 0;        ///< downwards [degrees]
  double yaw = 0;          ///< to the right [degrees]
  double focal_ratio = 1;  ///< focal length of the right camera relative to the left
  double row_offset = 0;   ///< the right image is lower by this [px]

  /// Whether the pair is rectified.
  bool aligned() const;
};

/// A pinhole camera.
struct Camera {
  double focal = 1;                   ///< [px]
  double center_x = 0, center_y = 0;  ///< principal point [px]
  Eigen::Isometry3d pose =            ///< transform from this camera to the left one
      Eigen::Isometry3d::Identity();

  /// The ray through a point of the image in the camera's coordinates; its z is 1.
  Eigen::Vector3d direction(double x, double y) const;
  /// The point of the image that a ray with z > 0 in the camera's coordinates passes through.
  cv::Point2d project(const Eigen::Vector3d& direction) const;
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

}  // namespace mtstereo::render
