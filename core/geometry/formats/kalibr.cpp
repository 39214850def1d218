// SPDX-License-Identifier: LGPL-2.1-or-later
// The camchain of Kalibr and open_vins: cam0, cam1 and so on. T_cn_cnm1 moves points from the
// camera before, T_cam_imu from the IMU to the camera, T_imu_cam from the camera to the IMU.
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "geometry/formats/parts.hpp"
#include "geometry/formats/readers.hpp"

namespace mtstereo::formats {
namespace {

constexpr int kMostCameras = 32;

/// The omni-radtan model: xi, fu, fv, pu, pv.
CameraCalibration read_omni(const Entry& entry, CameraCalibration camera) {
  const Entry intrinsics = entry.at("intrinsics");
  const std::vector<double> v = intrinsics.numbers(5, "xi, fu, fv, pu, pv");
  set_camera_matrix(camera, intrinsics, {v[1], 0, v[3], 0, v[2], v[4], 0, 0, 1});
  const Entry model = entry.at("distortion_model");
  const LensModel lens = lens_model(model);
  if (lens == LensModel::kFisheye) {
    model.fail("does not fit camera_model omni; calibrate with omni-radtan");
  }
  std::vector<double> distortion(4, 0.0);
  if (lens != LensModel::kNone) {
    distortion = entry.at("distortion_coeffs").numbers(4, "k1, k2, p1, p2");
  }
  Value xi;
  xi.text = number_text(v[0]);
  set_omnidirectional(camera, Entry(xi, entry.file(), intrinsics.name() + "[0]"), distortion);
  return camera;
}

CameraCalibration read_kalibr_camera(const Entry& entry) {
  CameraCalibration camera;
  const Entry model = entry.at("camera_model");
  set_size(camera, entry.at("resolution"));
  if (model.text() == "omni") return read_omni(entry, camera);
  if (model.text() != "pinhole") {
    model.fail("is '" + printable(model.text()) +
               "', which is not supported; calibrate with pinhole-radtan, pinhole-equi or "
               "omni-radtan");
  }
  set_intrinsics(camera, entry.at("intrinsics"));
  const LensModel lens = lens_model(entry.at("distortion_model"));
  const std::optional<Entry> coefficients = entry.find("distortion_coeffs");
  if (coefficients || lens != LensModel::kNone) {
    set_lens(camera, lens, entry.at("distortion_coeffs"));
  }
  return camera;
}

/// The number of "camN".
int camera_number(const Entry& file, const std::string& name) {
  for (int number = 0; number < kMostCameras; ++number) {
    if (name == "cam" + std::to_string(number)) return number;
  }
  file.fail("there is no camera " + printable(name));
}

/// From the axes of camera `from` to those of camera `to`, along the chain, if it is complete.
std::optional<Motion> motion_along_chain(const Entry& file, int from, int to) {
  if (from > to) {
    const std::optional<Motion> motion = motion_along_chain(file, to, from);
    return motion ? std::optional(motion->inverse()) : std::nullopt;
  }
  Motion motion;
  for (int n = from + 1; n <= to; ++n) {
    const std::optional<Entry> camera = file.find("cam" + std::to_string(n));
    const std::optional<Entry> link = camera ? camera->find("T_cn_cnm1") : std::nullopt;
    if (!link) return std::nullopt;
    motion = motion_from(*link).after(motion);
  }
  return motion;
}

/// From the axes of a camera to those of the IMU: T_imu_cam, or the inverse of T_cam_imu.
std::optional<Motion> motion_to_imu(const Entry& camera) {
  if (const std::optional<Entry> pose = camera.find("T_cam_imu")) {
    return motion_from(*pose).inverse();
  }
  const std::optional<Entry> pose = camera.find("T_imu_cam");
  return pose ? std::optional(motion_from(*pose)) : std::nullopt;
}

/// Fails if the chain and the IMU put the right camera to different places.
void check_agreement(const Entry& right, const Motion& chain, const Motion& imu) {
  constexpr double kLargestAngle = 1;     // [degrees]
  constexpr double kLargestShare = 0.05;  // of the baseline
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(chain.rotation.transpose() * imu.rotation));
  const double angle = std::abs(turn.angle()) * 180 / std::numbers::pi;
  const double length = chain.translation.norm();
  const double distance = (chain.translation - imu.translation).norm();
  if (angle <= kLargestAngle && distance <= kLargestShare * length) return;
  const auto rounded = [](double value) { return number_text(std::round(value * 1e4) / 1e4); };
  right.fail("states two positions that contradict each other: T_cn_cnm1 a baseline of " +
             rounded(length) + " m, the positions to the IMU " + rounded(imu.translation.norm()) +
             " m and a rotation that differs by " + rounded(angle) +
             " degrees; remove the wrong ones");
}

/// From the axes of the left camera to those of the right one.
Motion motion_between(const Entry& file, int left, int right) {
  const Entry left_camera = file.at("cam" + std::to_string(left));
  const Entry right_camera = file.at("cam" + std::to_string(right));
  const std::optional<Motion> chain = motion_along_chain(file, left, right);
  const std::optional<Motion> left_to_imu = motion_to_imu(left_camera);
  const std::optional<Motion> right_to_imu = motion_to_imu(right_camera);
  if (!left_to_imu || !right_to_imu) {
    if (chain) return *chain;
    right_camera.fail("has no entry T_cn_cnm1 (position after the camera before), and " +
                      left_camera.name() + " and " + right_camera.name() +
                      " have no T_cam_imu or T_imu_cam (position to the IMU)");
  }
  const Motion imu = right_to_imu->inverse().after(*left_to_imu);
  if (!chain) return imu;
  check_agreement(right_camera, *chain, imu);
  return *chain;
}

}  // namespace

StereoCalibration read_kalibr(const Entry& file, const Request& request) {
  Selection pair = {"cam0", "cam1"};
  if (!request.selection.empty()) pair = selected_pair(file, request.selection, "cam1-cam0");
  const int left = camera_number(file, pair.left);
  const int right = camera_number(file, pair.right);
  if (left == right) file.fail("the left and the right camera are both " + pair.left);
  StereoCalibration calibration;
  calibration.format = "Kalibr camchain";
  calibration.left = read_kalibr_camera(file.at(pair.left, "the left camera"));
  const Entry right_camera = file.at(pair.right, "the right camera");
  calibration.right = read_kalibr_camera(right_camera);
  const Motion motion = motion_between(file, left, right);
  check_translation(motion.translation, right_camera.find("T_cn_cnm1").value_or(right_camera),
                    ": the size of the target must be in meters");
  set_motion(calibration, motion);
  return calibration;
}

}  // namespace mtstereo::formats
