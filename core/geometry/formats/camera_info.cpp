// SPDX-License-Identifier: LGPL-2.1-or-later
// ROS: the camera_info files of camera_calibration, one per camera, and the message sensor_msgs/
// CameraInfo as "ros2 topic echo" and "rostopic echo" print it.
#include <optional>
#include <string>
#include <utility>

#include "geometry/formats/parts.hpp"
#include "geometry/formats/readers.hpp"

namespace mtstereo::formats {
namespace {

/// One camera of the pair.
struct Camera {
  CameraCalibration calibration;
  Eigen::Matrix3d rotation;
  std::vector<double> projection;
  Entry projection_entry;
};

/// The entry with one of the names: of the file, of the message of ROS 2, of that of ROS 1.
Entry any_of(const Entry& file, std::string_view name, std::string_view ros2,
             std::string_view ros1) {
  if (std::optional<Entry> entry = file.find_any({name, ros2, ros1})) return *std::move(entry);
  file.fail("there is no entry " + std::string(name));
}

Camera read_camera(const Entry& file) {
  const Entry projection = any_of(file, "projection_matrix", "p", "P");
  Camera camera{{}, {}, projection.numbers(12, "a 3x4 projection"), projection};
  set_size(camera.calibration, any_of(file, "image_width", "width", "width"),
           any_of(file, "image_height", "height", "height"));
  for (const char* name : {"binning_x", "binning_y"}) {
    const std::optional<Entry> binning = file.find(name);
    if (binning && binning->number() > 1) {
      binning->fail("is " + number_text(binning->number()) +
                    "; only calibrations of the whole image are supported");
    }
  }
  set_camera_matrix(camera.calibration, any_of(file, "camera_matrix", "k", "K"));
  const Entry coefficients = any_of(file, "distortion_coefficients", "d", "D");
  set_lens(camera.calibration, lens_model(file.at("distortion_model")), coefficients);
  camera.rotation = rotation_from(any_of(file, "rectification_matrix", "r", "R"));
  return camera;
}

}  // namespace

bool is_camera_info(const Entry& file) {
  const bool named = file.find("projection_matrix") && file.find("camera_matrix");
  const bool message =
      file.find("distortion_model") && file.find_any({"k", "K"}) && file.find_any({"p", "P"});
  const bool incomplete = file.find("camera_name") && file.find("camera_matrix");
  return named || message || incomplete;
}

StereoCalibration read_camera_info(const Entry& left_file, const Entry& right_file,
                                   const Request& request) {
  no_selection(left_file, request.selection);
  const Camera left = read_camera(left_file);
  const Camera right = read_camera(right_file);
  const RectifiedViews views = {left.rotation, right.rotation, left.projection, right.projection};
  const Entry& p1 = left.projection_entry;
  const Entry& p2 = right.projection_entry;
  Rectification rectification = rectification_from(views, p1, p2);
  if (rectification.baseline == 0) {
    p2.fail("states a baseline of 0: its fourth value is that of " + left_file.file() +
            "; calibrate both cameras together as a pair");
  }
  rectification.width = left.calibration.width;
  rectification.height = left.calibration.height;

  StereoCalibration calibration;
  calibration.format = "ROS camera_info";
  calibration.left = left.calibration;
  calibration.right = right.calibration;
  // The files have no R and T.
  const Motion motion = motion_of(rectification);
  check_translation(motion.translation, p2,
                    ": divide the fourth value of projection_matrix by 1000");
  set_motion(calibration, motion);
  calibration.rectification = rectification;
  return calibration;
}

}  // namespace mtstereo::formats
