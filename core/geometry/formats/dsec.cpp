// SPDX-License-Identifier: LGPL-2.1-or-later
// The cam_to_cam.yaml of DSEC: events of 0 and 3, frames of 1 and 2. The data set has the rectified
// views, whose cameras are camRectN. T_21 moves points from camera 1 to camera 2, R_rectN turns
// them to the axes of camRectN.
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "geometry/formats/parts.hpp"
#include "geometry/formats/readers.hpp"

namespace mtstereo::formats {
namespace {

Entry rectified_camera(const Entry& file, const std::string& number) {
  return file.at("intrinsics").at("camRect" + number);
}

std::vector<double> projection_of(const Entry& camera) {
  const std::vector<double> k = camera.at("camera_matrix").numbers(4, "fx, fy, cx, cy");
  return {k[0], 0, k[2], 0, 0, k[1], k[3], 0, 0, 0, 1, 0};
}

/// From the axes of the left camera to those of the right one.
Motion motion_between(const Entry& extrinsics, bool events) {
  const Motion frames = motion_from(extrinsics.at("T_21"));
  if (!events) return frames;
  return motion_from(extrinsics.at("T_32")).after(frames).after(motion_from(extrinsics.at("T_10")));
}

}  // namespace

bool is_dsec(const Entry& file) {
  const std::optional<Entry> cameras = file.find("intrinsics");
  return cameras && cameras->find("camRect0") && file.find("extrinsics");
}

StereoCalibration read_dsec(const Entry& file, const Request& request) {
  const bool events = request.selection == "0-3";
  if (!events && !request.selection.empty() && request.selection != "1-2") {
    file.fail("'#" + printable(request.selection) +
              "' selects no cameras; 1-2 (frames) and 0-3 (events) are pairs");
  }
  const std::string left = events ? "0" : "1", right = events ? "3" : "2";
  const Entry left_camera = rectified_camera(file, left);
  const Entry right_camera = rectified_camera(file, right);
  const Entry extrinsics = file.at("extrinsics");
  const Entry turn = extrinsics.at("R_rect" + right);
  const Eigen::Vector3d position =
      rotation_from(turn) * motion_between(extrinsics, events).translation;
  constexpr double kTolerance = 0.01;
  if (std::hypot(position.y(), position.z()) > kTolerance * position.norm()) {
    turn.fail("does not turn the other camera to the side, as a rectification does: it is at " +
              number_text(position.x()) + ", " + number_text(position.y()) + ", " +
              number_text(position.z()));
  }
  check_translation(position, turn, "; T_21 must be in meters");
  RectifiedViews views;
  views.left_projection = projection_of(left_camera);
  views.right_projection = projection_of(right_camera);
  views.right_projection[3] = position.x() * views.right_projection[0];
  Rectification rectification = rectification_from(views, left_camera, right_camera);
  CameraCalibration size;
  set_size(size, left_camera.at("resolution"));
  rectification.width = size.width;
  rectification.height = size.height;
  StereoCalibration calibration = rectified_cameras(rectification);
  calibration.format = "DSEC";
  return calibration;
}

}  // namespace mtstereo::formats
