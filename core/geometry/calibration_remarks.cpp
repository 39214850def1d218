// SPDX-License-Identifier: LGPL-2.1-or-later
#include "geometry/calibration_remarks.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace mtstereo {
namespace {

using Matrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

/// Baselines of usual pairs of cameras [m]: from a borescope to a vehicle.
constexpr double kShortBaseline = 0.005;
constexpr double kLongBaseline = 1;
/// How far from the middle of the image a principal point is without a word, as a part of the side.
constexpr double kUsualShift = 0.2;

std::string digits(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", number);
  return text;
}

/// How far a center is from the middle, as a part of the side.
double shift_of(double center, int side) { return std::abs(center - (side - 1) / 2.0) / side; }

bool are_near(const Matrix3& a, const Matrix3& b) {
  return std::equal(a.begin(), a.end(), b.begin(),
                    [](double x, double y) { return std::abs(x - y) <= 1e-9; });
}

void exchange(Rectification& rectification) {
  std::swap(rectification.left_rotation, rectification.right_rotation);
  std::swap(rectification.left_center_x, rectification.right_center_x);
  rectification.baseline = -rectification.baseline;
}

void note_center(const CameraCalibration& camera, const char* name,
                 std::vector<std::string>& remarks) {
  if (camera.width < 1 || camera.height < 1) return;
  const double shift =
      std::max(shift_of(camera.center_x, camera.width), shift_of(camera.center_y, camera.height));
  if (!(shift > kUsualShift)) return;
  remarks.push_back(
      std::string("The principal point of the ") + name + " camera, (" + digits(camera.center_x) +
      ", " + digits(camera.center_y) + "), is " + std::to_string(std::lround(100 * shift)) +
      " % of a side away from the middle of its image of " + std::to_string(camera.width) + "x" +
      std::to_string(camera.height) +
      " px: unless the image is a crop, the calibration belongs to another size. State the size of "
      "the calibration in its file (image_size: [ WIDTH, HEIGHT ]), and it is scaled.");
}

}  // namespace

void put_in_order(StereoCalibration& calibration) {
  const Vector3& t = calibration.translation;
  if (!(t[0] > 0) || std::abs(t[1]) > t[0]) return;
  Eigen::Map<Matrix> rotation(calibration.rotation.data());
  Eigen::Map<Eigen::Vector3d> translation(calibration.translation.data());
  const Eigen::Vector3d back = -(rotation.transpose() * translation);
  // An exchange must leave a pair in order; large rotations would not.
  if (!(back[0] < 0)) return;
  translation = back;
  rotation.transposeInPlace();
  std::swap(calibration.left, calibration.right);
  if (calibration.rectification) exchange(*calibration.rectification);
  calibration.remarks.emplace_back(
      "By its translation, the first camera of the calibration is to the right of the second one: "
      "they are exchanged, and the left view must be from the second camera. If it is from the "
      "first one, exchange the views; if R and T of the file are the pose of the right camera "
      "(X_left = R X_right + T), write their inverse, R' and -R' T.");
}

void state_rectification(StereoCalibration& calibration) {
  const CameraCalibration &left = calibration.left, &right = calibration.right;
  const bool pinholes = left.lens == LensModel::kNone && right.lens == LensModel::kNone;
  if (!pinholes || calibration.rectification || left.width != right.width) return;
  constexpr double kTolerance = 1e-3;  // [px], and of the baseline
  constexpr Matrix3 kIdentity = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  const auto are_equal = [](double a, double b) { return std::abs(a - b) <= kTolerance; };
  const Vector3& t = calibration.translation;
  const double focal = left.focal_x, baseline = -t[0];
  const bool parallel = are_near(calibration.rotation, kIdentity) &&
                        std::max(std::abs(t[1]), std::abs(t[2])) < kTolerance * baseline;
  const bool same = are_equal(right.focal_x, focal) && are_equal(right.focal_y, left.focal_y) &&
                    are_equal(right.center_x, left.center_x) &&
                    are_equal(right.center_y, left.center_y);
  if (!parallel || !same || std::abs(left.focal_y - focal) > kTolerance * focal) return;
  calibration.rectification =
      Rectification{left.width,    left.height,   kIdentity,     kIdentity, focal,
                    left.center_x, left.center_x, left.center_y, baseline};
}

void note_length(StereoCalibration& calibration, std::string_view remedy, std::string_view unit) {
  const double baseline = calibration.baseline();
  if (!std::isfinite(baseline) || (baseline >= kShortBaseline && baseline <= kLongBaseline)) return;
  calibration.remarks.push_back(
      "The baseline is " + digits(baseline) + " m, which is unusually " +
      (baseline < kShortBaseline ? "short" : "long") +
      ", and the file states no unit: depths are wrong unless its lengths are in " +
      std::string(unit) + ". Otherwise " + std::string(remedy) + ".");
}

void note_centers(StereoCalibration& calibration) {
  note_center(calibration.left, "left", calibration.remarks);
  note_center(calibration.right, "right", calibration.remarks);
}

}  // namespace mtstereo
