// SPDX-License-Identifier: LGPL-2.1-or-later
// stella_vslam and OpenVSLAM: Camera is the rectified view of both cameras, and StereoRectifier has
// the raw views, unless they are rectified already.
#include <optional>
#include <string>

#include "geometry/formats/parts.hpp"
#include "geometry/formats/readers.hpp"

namespace mtstereo::formats {
namespace {

/// "Camera.fx", or fx of the map Camera.
std::optional<Entry> find(const Entry& file, const std::string& section, const char* name) {
  if (std::optional<Entry> flat = file.find(section + "." + name)) return flat;
  const std::optional<Entry> map = file.find(section);
  return map ? map->find(name) : std::nullopt;
}

Entry at(const Entry& file, const std::string& section, const char* name) {
  if (std::optional<Entry> entry = find(file, section, name)) return *std::move(entry);
  file.fail("there is no entry " + section + "." + name);
}

Entry of_camera(const Entry& file, const char* name) { return at(file, "Camera", name); }
Entry of_rectifier(const Entry& file, const char* name) {
  return at(file, "StereoRectifier", name);
}

/// The projections; the rotations stay those of views that are rectified already.
RectifiedViews read_views(const Entry& file) {
  CameraCalibration camera;
  camera.focal_x = of_camera(file, "fx").number();
  camera.focal_y = of_camera(file, "fy").number();
  camera.center_x = of_camera(file, "cx").number();
  camera.center_y = of_camera(file, "cy").number();
  return views_of(camera, camera, of_camera(file, "focal_x_baseline").number());
}

}  // namespace

bool is_stella(const Entry& file) {
  return find(file, "Camera", "setup") && find(file, "Camera", "model");
}

StereoCalibration read_stella(const Entry& file, const Request& request) {
  no_selection(file, request.selection);
  const Entry setup = of_camera(file, "setup");
  if (setup.text() != "stereo") {
    setup.fail("is '" + printable(setup.text()) + "', only stereo has both cameras");
  }
  RectifiedViews views = read_views(file);
  const std::optional<Entry> raw = find(file, "StereoRectifier", "K_left");
  if (raw) {
    views.left_rotation = rotation_from(of_rectifier(file, "R_left"));
    views.right_rotation = rotation_from(of_rectifier(file, "R_right"));
  }
  const Entry product = of_camera(file, "focal_x_baseline");
  Rectification rectification = rectification_from(views, of_camera(file, "fx"), product);
  CameraCalibration size;
  set_size(size, of_camera(file, "cols"), of_camera(file, "rows"));
  rectification.width = size.width;
  rectification.height = size.height;
  StereoCalibration calibration = rectified_cameras(rectification);
  if (raw) {
    const std::optional<Entry> model = find(file, "StereoRectifier", "model");
    const LensModel lens = model ? lens_model(*model) : LensModel::kPlumbBob;
    set_camera_matrix(calibration.left, *raw);
    set_camera_matrix(calibration.right, of_rectifier(file, "K_right"));
    set_lens(calibration.left, lens, of_rectifier(file, "D_left"));
    set_lens(calibration.right, lens, of_rectifier(file, "D_right"));
    set_motion(calibration, motion_of(rectification));
    calibration.rectification = rectification;
  }
  const Vector3& t = calibration.translation;
  check_translation({t[0], t[1], t[2]}, product,
                    "; it must be the focal length in pixels times the baseline in meters");
  calibration.format = "stella_vslam";
  return calibration;
}

}  // namespace mtstereo::formats
