// SPDX-License-Identifier: LGPL-2.1-or-later
// Kalibr's camchain: cam0, cam1 and so on; T_cn_cnm1 moves points from the camera before.
#include <optional>
#include <string>

#include "geometry/formats/parts.hpp"
#include "geometry/formats/readers.hpp"

namespace mtstereo::formats {
namespace {

constexpr int kMostCameras = 32;

CameraCalibration read_camera(const Entry& entry) {
  CameraCalibration camera;
  const Entry model = entry.at("camera_model");
  if (model.text() != "pinhole") {
    model.fail("is '" + printable(model.text()) +
               "', which is not supported; calibrate with pinhole-radtan or pinhole-equi");
  }
  set_size(camera, entry.at("resolution"));
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

/// From the axes of camera `from` to those of camera `to`, along the chain.
Motion motion_between(const Entry& file, int from, int to) {
  if (from > to) return motion_between(file, to, from).inverse();
  Motion motion;
  for (int n = from + 1; n <= to; ++n) {
    const Entry camera = file.at("cam" + std::to_string(n), "a camera of the chain");
    motion = motion_from(camera.at("T_cn_cnm1", "position after the camera before")).after(motion);
  }
  return motion;
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
  calibration.left = read_camera(file.at(pair.left, "the left camera"));
  const Entry right_camera = file.at(pair.right, "the right camera");
  calibration.right = read_camera(right_camera);
  const Motion motion = motion_between(file, left, right);
  if (motion.translation.x() > 0) {
    right_camera.fail("is to the left of " + pair.left + ": the views are swapped; add '#" +
                      pair.right + "-" + pair.left + "' to the path to swap them");
  }
  check_translation(motion.translation, right_camera.find("T_cn_cnm1").value_or(right_camera),
                    ": the size of the target must be in meters");
  set_motion(calibration, motion);
  return calibration;
}

}  // namespace mtstereo::formats
