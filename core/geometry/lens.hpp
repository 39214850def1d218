// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <numbers>

#include "mtstereo/geometry/calibration.hpp"

namespace mtstereo {

/// A degree [rad].
inline constexpr double kDegree = std::numbers::pi / 180;

/// The lens model of one camera, in both directions, in double precision.
///
/// A polynomial that was fitted to the image is undefined in directions outside of it: there it may
/// turn back into the image. Such directions are not covered by the model.
class Lens {
 public:
  explicit Lens(const CameraCalibration& camera);

  /// The position in the image that shows the direction [px]; NaN if the model does not cover it.
  /// The direction need not have the length 1.
  std::array<double, 2> project(const Vector3& direction) const;

  /// The direction of a position in the image, of length 1; NaN if there is none.
  Vector3 direction(double u, double v) const;

  /// The angle from the optical axis up to which the model covers directions [rad].
  double widest_angle() const;

 private:
  using Point = std::array<double, 2>;
  Point distort(double x, double y) const;
  Point undistort(const Point& distorted) const;
  Point on_plane(const Vector3& direction) const;
  Vector3 off_plane(const Point& point) const;
  double radial(double radius) const;
  double inverse_radial(double distorted) const;
  void set_tilt(double x, double y);
  double largest_radius() const;

  CameraCalibration camera_;
  std::array<double, 14> k_{};  // as in CameraCalibration::coefficients, absent ones are 0
  Matrix3 tilt_{1, 0, 0, 0, 1, 0, 0, 0, 1};
  bool tilted_ = false;
  double xi_ = 0;     // of an omnidirectional lens: from the center of the sphere to its own
  double limit_ = 0;  // of the radius: tangent, or angle [rad] of a fisheye lens, or on the plane
                      // at the distance 1 from the center of an omnidirectional lens
};

}  // namespace mtstereo
