// SPDX-License-Identifier: LGPL-2.1-or-later
// ROS: the camera_info files of camera_calibration, one per camera, and the message sensor_msgs/
// CameraInfo as "ros2 topic echo" and "rostopic echo" print it.
#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "geometry/calibration_remarks.hpp"
#include "geometry/formats/parts.hpp"
#include "geometry/formats/readers.hpp"
#include "mtstereo/parameters.hpp"

namespace mtstereo::formats {
namespace {

constexpr const char* kAsPair = "calibrate both cameras together as a pair";

/// The entry with one of the names: of the file, of the message of ROS 2, of that of ROS 1.
Entry any_of(const Entry& file, std::string_view name, std::string_view ros2,
             std::string_view ros1) {
  if (std::optional<Entry> entry = file.find_any({name, ros2, ros1})) return *std::move(entry);
  file.fail("there is no entry " + std::string(name));
}

/// The part of the image that the video shows: the region of interest, and pixels that are one.
struct Region {
  double x = 0, y = 0;        ///< its first pixel [px of the whole image]
  int width = 0, height = 0;  ///< [px of the whole image]; 0: all of it
  int binning = 1;            ///< so many pixels along each axis are one
};

Region read_region(const Entry& file) {
  const auto integer = [](const std::optional<Entry>& map, const char* name) {
    const std::optional<Entry> entry = map ? map->find(name) : std::nullopt;
    return entry ? entry->integer(0, kLargestImageSide) : 0;
  };
  const std::optional<Entry> roi = file.find("roi");
  Region region;
  region.x = integer(roi, "x_offset");
  region.y = integer(roi, "y_offset");
  region.width = integer(roi, "width");
  region.height = integer(roi, "height");
  // 0 means 1.
  region.binning = std::max(1, integer(file, "binning_x"));
  const int rows = std::max(1, integer(file, "binning_y"));
  if (rows != region.binning) {
    file.fail("binning_x is " + std::to_string(region.binning) + " and binning_y " +
              std::to_string(rows) + "; they must be equal");
  }
  return region;
}

/// K of the region. The corner of the first pixel stays where it is.
void apply_region(const Region& region, CameraCalibration& camera) {
  const double scale = 1.0 / region.binning;
  camera.focal_x *= scale;
  camera.focal_y *= scale;
  camera.center_x = (camera.center_x - region.x + 0.5) * scale - 0.5;
  camera.center_y = (camera.center_y - region.y + 0.5) * scale - 0.5;
  if (region.width > 0) camera.width = region.width;
  if (region.height > 0) camera.height = region.height;
  camera.width = std::max(1, camera.width / region.binning);
  camera.height = std::max(1, camera.height / region.binning);
}

/// The same for the rectified views. Both get the region of the left camera, so that rows stay
/// rows.
void apply_region(const Region& region, Rectification& rectification) {
  const double scale = 1.0 / region.binning;
  rectification.focal_length *= scale;
  for (double* center : {&rectification.left_center_x, &rectification.right_center_x}) {
    *center = (*center - region.x + 0.5) * scale - 0.5;
  }
  rectification.center_y = (rectification.center_y - region.y + 0.5) * scale - 0.5;
}

/// The lens model. Some programs name it camera_model; a file without it has the plumb bob for the
/// readers of ROS, which is only possible with five coefficients.
LensModel stated_lens(const Entry& file, const Entry& coefficients) {
  constexpr std::size_t kPlumbBobCount = 5;
  if (const auto model = file.find_any({"distortion_model", "camera_model"})) {
    return lens_model(*model);
  }
  if (coefficients.numbers().size() == kPlumbBobCount) return LensModel::kPlumbBob;
  file.fail("there is no entry distortion_model (plumb_bob, rational_polynomial or equidistant)");
}

/// One camera of the pair.
struct RosCamera {
  CameraCalibration calibration;  ///< of the region
  Eigen::Matrix3d rotation;
  std::vector<double> projection;  ///< of the whole image
  Entry projection_entry;
  Region region;
};

RosCamera read_ros_camera(const Entry& file) {
  if (!file.find_any({"projection_matrix", "p", "P"})) {
    file.fail("there is no entry projection_matrix, which states the position of the cameras; " +
              std::string(kAsPair));
  }
  const Entry projection = any_of(file, "projection_matrix", "p", "P");
  RosCamera camera{
      {}, {}, projection.numbers(12, "a 3x4 projection"), projection, read_region(file)};
  set_size(camera.calibration, any_of(file, "image_width", "width", "width"),
           any_of(file, "image_height", "height", "height"));
  set_camera_matrix(camera.calibration, any_of(file, "camera_matrix", "k", "K"));
  const Entry coefficients = any_of(file, "distortion_coefficients", "d", "D");
  set_lens(camera.calibration, stated_lens(file, coefficients), coefficients);
  camera.rotation = rotation_from(any_of(file, "rectification_matrix", "r", "R"));
  apply_region(camera.region, camera.calibration);
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
  const RosCamera left = read_ros_camera(left_file);
  const RosCamera right = read_ros_camera(right_file);
  const RectifiedViews views = {left.rotation, right.rotation, left.projection, right.projection};
  const Entry& p1 = left.projection_entry;
  const Entry& p2 = right.projection_entry;
  // Before the rest: the projections of cameras that are calibrated alone differ in all values.
  if (left.projection[3] == right.projection[3] && left.projection[7] == right.projection[7]) {
    p2.fail("states a baseline of 0: its fourth value equals that in " + left_file.file() + "; " +
            kAsPair);
  }
  Rectification rectification = rectification_from(views, p1, p2);
  if (left.region.binning != right.region.binning) {
    right_file.fail("binning_x differs from " + left_file.file() + "; they must be equal");
  }
  apply_region(left.region, rectification);
  rectification.width = left.calibration.width;
  rectification.height = left.calibration.height;

  StereoCalibration calibration;
  calibration.format = "ROS camera_info";
  calibration.left = left.calibration;
  calibration.right = right.calibration;
  // The files have no R and T.
  const Motion motion = motion_of(rectification);
  check_translation(motion.translation, p2,
                    ": divide the fourth value of projection_matrix by 1000, or by 100 if it is in "
                    "centimeters");
  set_motion(calibration, motion);
  note_length(calibration,
              "divide the fourth value of projection_matrix in the file of the right camera by 100 "
              "if it is in centimeters, or by 1000 if it is in millimeters");
  calibration.rectification = rectification;
  return calibration;
}

}  // namespace mtstereo::formats
