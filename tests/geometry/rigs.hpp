// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "mtstereo/geometry/calibration.hpp"

namespace mtstereo::test {

/// A rotation about x, y and z, in this order [degrees].
inline Matrix3 rotation_of(double x, double y, double z) {
  constexpr double kDegree = std::numbers::pi / 180;
  const double cx = std::cos(x * kDegree);
  const double sx = std::sin(x * kDegree);
  const double cy = std::cos(y * kDegree);
  const double sy = std::sin(y * kDegree);
  const double cz = std::cos(z * kDegree);
  const double sz = std::sin(z * kDegree);
  return {cy * cz,
          sx * sy * cz - cx * sz,
          cx * sy * cz + sx * sz,
          cy * sz,
          sx * sy * sz + cx * cz,
          cx * sy * sz - sx * cz,
          -sy,
          sx * cy,
          cx * cy};
}

inline CameraCalibration camera(int width, int height, double focal, LensModel lens,
                                const std::vector<double>& coefficients) {
  CameraCalibration result;
  result.width = width;
  result.height = height;
  result.focal_x = focal;
  result.focal_y = focal * 1.003;
  result.center_x = width / 2.0 + 3.7;
  result.center_y = height / 2.0 - 2.3;
  result.lens = lens;
  result.coefficients = coefficients;
  return result;
}

/// Two cameras with a baseline of about 12 cm, turned to each other by a few degrees.
inline StereoCalibration rig_of(const CameraCalibration& left, const CameraCalibration& right) {
  StereoCalibration rig;
  rig.left = left;
  rig.right = right;
  rig.right.center_x -= 5.1;
  rig.right.center_y += 4.4;
  rig.rotation = rotation_of(0.8, -2.1, 1.3);
  rig.translation = {-0.12, 0.003, -0.005};
  return rig;
}

/// A usual lens, with radial and tangential distortion.
inline StereoCalibration plumb_bob_rig(int width = 640, int height = 480) {
  const double focal = 0.8 * width;
  return rig_of(
      camera(width, height, focal, LensModel::kPlumbBob, {-0.28, 0.09, 0.0006, -0.0004, -0.012}),
      camera(width, height, focal * 1.01, LensModel::kPlumbBob,
             {-0.29, 0.1, -0.0003, 0.0005, -0.015}));
}

/// All 14 coefficients: rational, thin prism and tilted sensor.
inline StereoCalibration tilted_rig(int width = 640, int height = 400) {
  const std::vector<double> coefficients = {2.1,  -1.2, 0.0004, -0.0007, 0.3,  2.4,   -0.9,
                                            0.12, 2e-3, -5e-4,  -1e-3,   3e-4, 0.012, -0.008};
  const CameraCalibration one =
      camera(width, height, 0.7 * width, LensModel::kPlumbBob, coefficients);
  return rig_of(one, one);
}

/// Fisheye lenses of 120 degrees from left to right.
inline StereoCalibration fisheye_rig(int width = 640, int height = 480) {
  const double focal = width / (120 * std::numbers::pi / 180);
  return rig_of(
      camera(width, height, focal, LensModel::kFisheye, {-0.013, 0.004, -0.003, 0.0006}),
      camera(width, height, focal * 0.995, LensModel::kFisheye, {-0.011, 0.003, -0.002, 0.0004}));
}

/// Two equal cameras side by side that look in nearly the same direction.
inline StereoCalibration wide_rig(const CameraCalibration& one) {
  StereoCalibration rig = rig_of(one, one);
  rig.rotation = rotation_of(0.4, -0.3, 0.7);
  rig.translation = {-0.08, 0.001, 0.0005};
  return rig;
}

/// Rational lenses with a pole where numerator and denominator are nearly zero: at a radius of
/// about 0.8, which is at the sides of the image. Behind it, the model returns to the image.
inline StereoCalibration pole_rig() {
  const std::vector<double> coefficients = {-7.98, 55.4, 0.0003, -0.0002, -67.9, -8.06, 55.6,
                                            -68.0, 0,    0,      0,       0,     0,     0};
  return wide_rig(camera(1280, 800, 805, LensModel::kPlumbBob, coefficients));
}

/// Lenses whose polynomial turns back in front of the corners of the image.
inline StereoCalibration turning_rig() {
  const std::vector<double> coefficients = {-0.058, 0.035, -0.0003, 0.0002, -0.0152};
  return wide_rig(camera(1280, 720, 530, LensModel::kPlumbBob, coefficients));
}

/// Fisheye lenses of this field of view from left to right [degrees].
inline StereoCalibration fisheye_rig_of(double field, int width = 640, int height = 480) {
  const double focal = width / (field * std::numbers::pi / 180);
  return wide_rig(
      camera(width, height, focal, LensModel::kFisheye, {0.004, 0.003, -0.004, 0.0006}));
}

inline StereoCalibration pinhole_rig(int width = 640, int height = 480) {
  const CameraCalibration one = camera(width, height, 0.9 * width, LensModel::kNone, {});
  return rig_of(one, one);
}

/// One of each.
inline std::vector<StereoCalibration> all_rigs() {
  return {pinhole_rig(), plumb_bob_rig(), tilted_rig(), fisheye_rig()};
}

inline Vector3 product(const Matrix3& m, const Vector3& v) {
  return {m[0] * v[0] + m[1] * v[1] + m[2] * v[2], m[3] * v[0] + m[4] * v[1] + m[5] * v[2],
          m[6] * v[0] + m[7] * v[1] + m[8] * v[2]};
}

/// The coordinates in the right camera of a point in those of the left one.
inline Vector3 in_right_camera(const StereoCalibration& rig, const Vector3& point) {
  Vector3 result = product(rig.rotation, point);
  for (std::size_t i = 0; i < 3; ++i) result[i] += rig.translation[i];
  return result;
}

}  // namespace mtstereo::test
