// SPDX-License-Identifier: LGPL-2.1-or-later
// EuRoC (ASL): one sensor.yaml per camera; T_BS moves points from the camera to the body.
#include <optional>

#include "geometry/formats/parts.hpp"
#include "geometry/formats/readers.hpp"

namespace mtstereo::formats {
namespace {

CameraCalibration read_euroc_camera(const Entry& file) {
  CameraCalibration camera;
  const std::optional<Entry> model = file.find("camera_model");
  if (model && model->text() != "pinhole") {
    model->fail("is '" + printable(model->text()) + "', only pinhole is supported");
  }
  set_size(camera, file.at("resolution"));
  set_intrinsics(camera, file.at("intrinsics"));
  const LensModel lens = lens_model(file.at("distortion_model"));
  const std::optional<Entry> coefficients = file.find("distortion_coefficients");
  if (coefficients || lens != LensModel::kNone) {
    set_lens(camera, lens, file.at("distortion_coefficients"));
  }
  return camera;
}

}  // namespace

StereoCalibration read_euroc(const Entry& left, const Entry& right, const Request& request) {
  no_selection(left, request.selection);
  StereoCalibration calibration;
  calibration.format = "EuRoC sensor.yaml";
  calibration.left = read_euroc_camera(left);
  calibration.right = read_euroc_camera(right);
  set_motion_on_body(calibration, left.at("T_BS", "the position on the body"),
                     right.at("T_BS", "the position on the body"));
  return calibration;
}

}  // namespace mtstereo::formats
