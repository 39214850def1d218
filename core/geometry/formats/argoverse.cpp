// SPDX-License-Identifier: LGPL-2.1-or-later
// The cameras of a vehicle of Argoverse. The raw pair has radial distortion and poses on the
// vehicle; of the rectified one, Txf_ is the focal length times the position of the right camera.
#include <optional>
#include <string>
#include <vector>

#include "geometry/formats/parts.hpp"
#include "geometry/formats/readers.hpp"

namespace mtstereo::formats {
namespace {

/// The camera whose key ends with a name.
std::optional<Entry> find_camera(const Entry& file, const std::string& name) {
  for (const Entry& camera : file.at("camera_data_").list()) {
    const std::string key = camera.at("key").text();
    if (key == name || key == "image_raw_" + name) return camera.at("value");
  }
  return std::nullopt;
}

CameraCalibration read_pinhole(const Entry& entry) {
  CameraCalibration camera;
  const auto number = [&entry](const char* name) { return entry.at(name).number(); };
  set_camera_matrix(camera, entry,
                    {number("focal_length_x_px_"), number("skew_"), number("focal_center_x_px_"), 0,
                     number("focal_length_y_px_"), number("focal_center_y_px_"), 0, 0, 1});
  return camera;
}

CameraCalibration read_raw(const Entry& entry, const Request& request) {
  CameraCalibration camera = read_pinhole(entry);
  const std::vector<double> k = entry.at("distortion_coefficients_").numbers(3, "k1, k2, k3");
  camera.lens = LensModel::kPlumbBob;
  camera.coefficients = {k[0], k[1], 0, 0, k[2]};
  camera.width = request.width;
  camera.height = request.height;
  return camera;
}

Motion read_vehicle_pose(const Entry& entry) {
  const Entry pose = entry.at("vehicle_SE3_camera_");
  const Entry turn = pose.at("rotation").at("coefficients");
  const std::vector<double> q = turn.numbers(4, "a quaternion");
  const std::vector<double> t = pose.at("translation").numbers(3, "a vector");
  return {rotation_of_quaternion(turn, q[0], q[1], q[2], q[3]), {t[0], t[1], t[2]}};
}

StereoCalibration read_raw_pair(const Entry& left, const Entry& right, const Request& request) {
  StereoCalibration calibration;
  calibration.left = read_raw(left, request);
  calibration.right = read_raw(right, request);
  const Motion motion = read_vehicle_pose(right).inverse().after(read_vehicle_pose(left));
  check_translation(motion.translation, right, "; it must be in meters");
  set_motion(calibration, motion);
  return calibration;
}

StereoCalibration read_rectified_pair(const Entry& left, const Entry& right,
                                      const Request& request) {
  const CameraCalibration first = read_pinhole(left);
  const CameraCalibration second = read_pinhole(right);
  const Entry product = right.at("Txf_", "the focal length times the position of the camera");
  Rectification rectification =
      rectification_from(views_of(first, second, -product.number()), left, right);
  check_translation({-rectification.baseline, 0, 0}, product, "; it must be in px m");
  rectification.width = request.width;
  rectification.height = request.height;
  return rectified_cameras(rectification);
}

}  // namespace

StereoCalibration read_argoverse(const Entry& file, const Request& request) {
  const bool raw = request.selection == "raw";
  if (!raw && !request.selection.empty() && request.selection != "rectified") {
    file.fail("'#" + printable(request.selection) +
              "' selects no cameras; raw and rectified are pairs");
  }
  const auto find = [&file](const char* name) { return find_camera(file, name); };
  const std::optional<Entry> left = find("stereo_front_left"), right = find("stereo_front_right");
  const std::optional<Entry> left_rectified = find("stereo_front_left_rect"),
                             right_rectified = find("stereo_front_right_rect");
  StereoCalibration calibration;
  if (!raw && left_rectified && right_rectified) {
    calibration = read_rectified_pair(*left_rectified, *right_rectified, request);
  } else if (left && right && (raw || request.selection.empty())) {
    calibration = read_raw_pair(*left, *right, request);
  } else {
    file.fail("has no stereo pair (stereo_front_left and stereo_front_right, or those with _rect)" +
              std::string(raw || request.selection.empty() ? "" : ", as '#rectified' selects"));
  }
  calibration.format = "Argoverse";
  return calibration;
}

}  // namespace mtstereo::formats
