// SPDX-License-Identifier: LGPL-2.1-or-later
// Anipose, FreeMoCap, Caliscope, Pose2Sim: a table per camera, such as [cam_0]. Rotation, as a
// vector, and translation move points from the world to the camera.
#include <optional>
#include <string>
#include <vector>

#include "geometry/calibration_remarks.hpp"
#include "geometry/formats/parts.hpp"
#include "geometry/formats/readers.hpp"

namespace mtstereo::formats {
namespace {

constexpr const char* kRemedyOfUnit =
    "add the line 'length_unit = \"mm\"' (or cm) before the first table";

std::vector<std::string> names_of_cameras(const Entry& file) {
  std::vector<std::string> names;
  for (const std::string& name : file.value().names) {
    const std::optional<Entry> camera = file.find(name);
    const bool complete = camera && camera->find("matrix") && camera->find("distortions") &&
                          camera->find("rotation") && camera->find("translation");
    if (complete) names.push_back(name);
  }
  return names;
}

CameraCalibration read_table(const Entry& entry) {
  CameraCalibration camera;
  set_size(camera, entry.at("size"));
  set_camera_matrix(camera, entry.at("matrix"));
  const std::optional<Entry> fisheye = entry.find("fisheye");
  const bool wide = fisheye && fisheye->text() == "true";
  set_lens(camera, wide ? LensModel::kFisheye : LensModel::kPlumbBob, entry.at("distortions"));
  return camera;
}

Motion from_world(const Entry& camera, double unit) {
  const std::vector<double> t = camera.at("translation").numbers(3, "a vector");
  return {rotation_from(camera.at("rotation")), Eigen::Vector3d(t[0], t[1], t[2]) * unit};
}

}  // namespace

bool has_camera_tables(const Entry& file) {
  return file.is_map() && names_of_cameras(file).size() > 1;
}

StereoCalibration read_camera_tables(const Entry& file, const Request& request) {
  const std::vector<std::string> names = names_of_cameras(file);
  Selection pair = {names[0], names[1]};
  if (!request.selection.empty()) {
    pair = selected_pair(file, request.selection, names[1] + "-" + names[0]);
  }
  const Entry left = file.at(pair.left, "the left camera");
  const Entry right = file.at(pair.right, "the right camera");
  const std::optional<Entry> unit = file.find("length_unit");
  const double meters = unit ? length_unit(*unit) : 1;
  StereoCalibration calibration;
  calibration.format = "camera tables";
  calibration.left = read_table(left);
  calibration.right = read_table(right);
  const Motion motion = from_world(right, meters).after(from_world(left, meters).inverse());
  check_translation(motion.translation, right.at("translation"), std::string(": ") + kRemedyOfUnit);
  set_motion(calibration, motion);
  if (!unit) note_length(calibration, kRemedyOfUnit);
  return calibration;
}

}  // namespace mtstereo::formats
