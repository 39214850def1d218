// SPDX-License-Identifier: LGPL-2.1-or-later
// AirSLAM: cam0 and cam1 as in a camchain of Kalibr, with one size and one lens model for both. T
// moves points from the camera to the body, or the other way if T_type is 1.
#include <array>
#include <optional>

#include "geometry/formats/parts.hpp"
#include "geometry/formats/readers.hpp"

namespace mtstereo::formats {
namespace {

CameraCalibration read_airslam_camera(const Entry& file, const Entry& entry) {
  constexpr std::array kModels = {LensModel::kNone, LensModel::kPlumbBob, LensModel::kFisheye};
  const int type = file.at("distortion_type").integer(0, 2);
  const LensModel lens = kModels[static_cast<std::size_t>(type)];
  CameraCalibration camera;
  set_size(camera, file.at("image_width"), file.at("image_height"));
  set_intrinsics(camera, entry.at("intrinsics"));
  const Entry coefficients = entry.at("distortion_coeffs");
  Value used = coefficients.value();
  constexpr std::size_t kOfFisheye = 4;  // the fifth one has no meaning
  if (lens == LensModel::kFisheye && used.items.size() > kOfFisheye) used.items.resize(kOfFisheye);
  set_lens(camera, lens, Entry(used, entry.file(), coefficients.name()));
  return camera;
}

Motion motion_to_body(const Entry& camera) {
  const Motion motion = motion_from(camera.at("T", "the position of the camera"));
  return camera.at("T_type").integer(0, 1) == 1 ? motion.inverse() : motion;
}

}  // namespace

bool is_airslam(const Entry& file) {
  const std::optional<Entry> camera = file.find("cam0");
  return file.find("distortion_type") && camera && camera->find("T_type");
}

StereoCalibration read_airslam(const Entry& file, const Request& request) {
  no_selection(file, request.selection);
  const Entry left = file.at("cam0", "the left camera");
  const Entry right = file.at("cam1", "the right camera");
  StereoCalibration calibration;
  calibration.format = "AirSLAM";
  calibration.left = read_airslam_camera(file, left);
  calibration.right = read_airslam_camera(file, right);
  const Motion motion = motion_to_body(right).inverse().after(motion_to_body(left));
  check_translation(motion.translation, right.at("T"), "; it must be in meters");
  set_motion(calibration, motion);
  return calibration;
}

}  // namespace mtstereo::formats
