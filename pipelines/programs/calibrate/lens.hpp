// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <string>

#include "mtstereo/geometry/calibration.hpp"

namespace mtstereo::calibrate {

/// The lens models that can be fitted.
enum class Model {
  kPlumbBob,  ///< k1 k2 p1 p2 k3
  kRational,  ///< k1 k2 p1 p2 k3 k4 k5 k6, for wide lenses
  kFisheye,   ///< k1 k2 k3 k4 of the equidistant model
};

/// "plumb-bob", "rational" or "fisheye".
const char* model_name(Model model);

/// Focal lengths, principal point and coefficients.
inline constexpr int kMostParameters = 12;
/// fx, fy, cx, cy: the first parameters of each model.
inline constexpr int kPinholeParameters = 4;

/// The number of parameters of a model.
int parameter_count(Model model);

/// An image point, and its derivatives.
struct Projection {
  Eigen::Vector2d pixel;                                ///< [px]
  Eigen::Matrix<double, 2, 3> by_point;                 ///< by the point
  Eigen::Matrix<double, 2, kMostParameters> by_values;  ///< by the parameters of the model, then 0
};

/// A camera with its lens.
struct Camera {
  Model model = Model::kPlumbBob;
  int width = 0;                                 ///< [px]
  int height = 0;                                ///< [px]
  std::array<double, kMostParameters> values{};  ///< fx fy cx cy [px], then the coefficients

  double focal() const { return (values[0] + values[1]) / 2; }

  /// The image of a point in the camera's coordinates [px]. std::nullopt for points behind the
  /// camera; the fisheye model has an image for all but the point opposite to its axis.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& point) const;

  /// The same with its derivatives.
  std::optional<Projection> linearize(const Eigen::Vector3d& point) const;

  /// The direction that a pixel sees, of unit length. std::nullopt where the lens model has none.
  std::optional<Eigen::Vector3d> ray(const Eigen::Vector2d& pixel) const;
};

/// A camera without distortion whose focal length is `focal` [px].
Camera ideal_camera(Model model, int width, int height, double focal);

/// From one camera's or board's coordinates to another's: rotation * X + translation.
struct Pose {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  Eigen::Vector3d operator*(const Eigen::Vector3d& point) const {
    return rotation * point + translation;
  }
  Pose operator*(const Pose& first) const {
    return {rotation * first.rotation, rotation * first.translation + translation};
  }
  Pose inverse() const { return {rotation.transpose(), -(rotation.transpose() * translation)}; }
  /// Turned by the rotation vector `step.head(3)` [rad] and shifted by `step.tail(3)`.
  Pose moved(const Eigen::Matrix<double, 6, 1>& step) const;
};

/// Two cameras. The right pose maps from the left camera to the right one [m].
struct Rig {
  Camera left;
  Camera right;
  Pose right_from_left;

  double baseline() const { return right_from_left.translation.norm(); }
};

/// The rig as a calibration of the library.
StereoCalibration calibration_of(const Rig& rig);

}  // namespace mtstereo::calibrate
