// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/render/raw.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <memory>
#include <stdexcept>

#include "tools/render/lens.hpp"

namespace mtstereo::render {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

Camera left_of(const StereoCalibration& c) {
  Camera camera;
  camera.lens = std::make_shared<const Lens>(c.left, "the left camera");
  return camera;
}

Camera right_of(const StereoCalibration& c) {
  Camera camera;
  camera.lens = std::make_shared<const Lens>(c.right, "the right camera");
  const Matrix3d rotation = Eigen::Map<const RowMajor>(c.rotation.data());
  const Vector3d translation = Eigen::Map<const Vector3d>(c.translation.data());
  const double skew = (rotation.transpose() * rotation - Matrix3d::Identity()).norm();
  if (!(skew < 1e-4) || !(rotation.determinant() > 0)) {
    throw std::invalid_argument("the rotation between the cameras is not a rotation matrix");
  }
  if (!translation.allFinite() || translation.norm() == 0) {
    throw std::invalid_argument("the translation between the cameras must be finite and not zero");
  }
  camera.pose.linear() = rotation.transpose();
  camera.pose.translation() = -rotation.transpose() * translation;
  return camera;
}

// Turned to the right, downwards and clockwise [degrees].
Matrix3d turned(double yaw, double pitch, double roll) {
  return (AngleAxisd(yaw * kDegree, Vector3d::UnitY()) *
          AngleAxisd(-pitch * kDegree, Vector3d::UnitX()) *
          AngleAxisd(roll * kDegree, Vector3d::UnitZ()))
      .toRotationMatrix();
}

// `pose`: the axes of the right camera in those of the left one. `place`: the direction from the
// left to the right camera.
void set_pose(StereoCalibration& c, const Matrix3d& pose, const Vector3d& place, double baseline) {
  Eigen::Map<RowMajor>(c.rotation.data()) = pose.transpose();
  Eigen::Map<Vector3d>(c.translation.data()) = -baseline * (pose.transpose() * place.normalized());
}

// A camera of the settings' size. `focal` is relative to the width, the center is shifted from that
// of the image by fractions of the width.
CameraCalibration camera_of(const Settings& s, double focal, double aspect, double shift_x,
                            double shift_y) {
  CameraCalibration c;
  c.width = s.width, c.height = s.height;
  c.focal_x = focal * s.width, c.focal_y = focal * aspect * s.width;
  c.center_x = (s.width - 1) / 2.0 + shift_x * s.width;
  c.center_y = (s.height - 1) / 2.0 + shift_y * s.width;
  return c;
}

StereoCalibration wide_rig(const Settings& s) {
  StereoCalibration c;
  c.left = camera_of(s, 0.75, 1.002, 0.006, -0.004);
  c.left.lens = LensModel::kPlumbBob;
  c.left.coefficients = {-0.19, 0.045, 0.0006, -0.0004, -0.004};
  c.right = camera_of(s, 0.759, 0.999, -0.008, 0.005);
  c.right.lens = LensModel::kPlumbBob;
  c.right.coefficients = {-0.2, 0.05, -0.0003, 0.0005, -0.005};
  set_pose(c, turned(-1.2, 0.8, 1.5), {1, 0.012, -0.015}, s.baseline);
  return c;
}

StereoCalibration fisheye_rig(const Settings& s) {
  // The focal length at which half of the width is 60 degrees, with the coefficients below.
  constexpr double kHalf = 60 * kDegree, kHalf2 = kHalf * kHalf;
  const std::vector<double> lens = {-0.02, 0.005, -0.002, 0.0002};
  const double stretched =
      kHalf * (1 + kHalf2 * (lens[0] + kHalf2 * (lens[1] + kHalf2 * (lens[2] + kHalf2 * lens[3]))));
  StereoCalibration c;
  c.left = camera_of(s, 0.5 / stretched, 1.001, 0.004, -0.003);
  c.left.lens = LensModel::kFisheye;
  c.left.coefficients = lens;
  c.right = camera_of(s, 0.503 / stretched, 0.999, -0.005, 0.004);
  c.right.lens = LensModel::kFisheye;
  c.right.coefficients = {-0.018, 0.004, -0.0018, 0.0002};
  set_pose(c, turned(-1, 1.2, 1.4), {1, -0.01, 0.012}, s.baseline);
  return c;
}

}  // namespace

RawRig::RawRig(const StereoCalibration& given)
    : calibration(given), left(left_of(given)), right(right_of(given)) {}

StereoCalibration calibration_of(const Settings& settings) {
  const auto pinhole = [&settings](const Camera& camera) {
    CameraCalibration c;
    c.width = settings.width, c.height = settings.height;
    c.focal_x = c.focal_y = camera.focal;
    c.center_x = camera.center_x, c.center_y = camera.center_y;
    return c;
  };
  const Camera right = right_camera(settings);
  StereoCalibration c;
  c.left = pinhole(left_camera(settings));
  c.right = pinhole(right);
  set_pose(c, right.pose.linear(), Vector3d::UnitX(), settings.baseline);
  c.rectification = rectification_of(settings);
  Eigen::Map<RowMajor>(c.rectification->right_rotation.data()) = right.pose.linear();
  return c;
}

const std::vector<std::string>& rig_names() {
  static const std::vector<std::string> names = {"wide", "fisheye"};
  return names;
}

StereoCalibration built_in_rig(std::string_view name, const Settings& settings) {
  if (name == "wide") return wide_rig(settings);
  if (name == "fisheye") return fisheye_rig(settings);
  throw std::invalid_argument("there is no lens '" + std::string(name) +
                              "'; the lenses are wide, fisheye");
}

}  // namespace mtstereo::render
