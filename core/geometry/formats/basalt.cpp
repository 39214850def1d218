// SPDX-License-Identifier: LGPL-2.1-or-later
// Basalt: T_imu_cam moves points from a camera to the IMU, as a position and a quaternion.
#include <string>
#include <vector>

#include "geometry/formats/parts.hpp"
#include "geometry/formats/readers.hpp"

namespace mtstereo::formats {
namespace {

CameraCalibration read_camera(const Entry& entry, const Entry& resolution) {
  CameraCalibration camera;
  set_size(camera, resolution);
  const Entry type = entry.at("camera_type", "the lens model");
  const std::string model = type.text();
  const Entry values = entry.at("intrinsics");
  const auto numbers = [&](std::initializer_list<const char*> names) {
    std::vector<double> list;
    for (const char* name : names) list.push_back(values.at(name).number());
    return list;
  };
  if (model == "kb4") {
    camera.lens = LensModel::kFisheye;
    camera.coefficients = numbers({"k1", "k2", "k3", "k4"});
  } else if (model == "pinhole-radtan8") {
    camera.lens = LensModel::kPlumbBob;
    camera.coefficients = numbers({"k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"});
  } else if (model != "pinhole") {
    type.fail("is '" + printable(model) +
              "', which is not supported; calibrate with kb4 or pinhole-radtan8");
  }
  const std::vector<double> k = numbers({"fx", "fy", "cx", "cy"});
  set_camera_matrix(camera, values, {k[0], 0, k[2], 0, k[1], k[3], 0, 0, 1});
  return camera;
}

Motion read_sensor_pose(const Entry& entry) {
  const auto number = [&](const char* name) { return entry.at(name).number(); };
  Motion motion;
  motion.rotation =
      rotation_of_quaternion(entry, number("qw"), number("qx"), number("qy"), number("qz"));
  motion.translation = {number("px"), number("py"), number("pz")};
  return motion;
}

}  // namespace

bool is_basalt(const Entry& file) {
  const std::optional<Entry> value = file.find("value0");
  return value && value->find("T_imu_cam") && value->find("intrinsics");
}

StereoCalibration read_basalt(const Entry& file, const Request& request) {
  const Entry value = file.at("value0");
  const std::vector<Entry> poses = value.at("T_imu_cam").list();
  const std::vector<Entry> cameras = value.at("intrinsics").list();
  const std::vector<Entry> sizes = value.at("resolution", "the sizes of the images").list();
  const std::size_t count = std::min({poses.size(), cameras.size(), sizes.size()});
  const auto [left, right] = selected_cameras(file, request.selection, count);
  StereoCalibration calibration;
  calibration.format = "Basalt";
  calibration.left = read_camera(cameras[left], sizes[left]);
  calibration.right = read_camera(cameras[right], sizes[right]);
  const Motion motion =
      read_sensor_pose(poses[right]).inverse().after(read_sensor_pose(poses[left]));
  check_translation(motion.translation, poses[right], "; it must be in meters");
  set_motion(calibration, motion);
  return calibration;
}

}  // namespace mtstereo::formats
