// SPDX-License-Identifier: LGPL-2.1-or-later
// The calib.txt of Middlebury and ETH3D: rectified cameras, the baseline in millimeters.
#include <cmath>
#include <optional>

#include "geometry/calibration_remarks.hpp"
#include "geometry/formats/parts.hpp"
#include "geometry/formats/readers.hpp"

namespace mtstereo::formats {

StereoCalibration read_middlebury(const Entry& file, const Request& request) {
  no_selection(file, request.selection);
  const Entry left = file.at("cam0", "K of the left camera");
  const Entry right = file.at("cam1", "K of the right camera");
  const Entry baseline = file.at("baseline", "in millimeters");
  StereoCalibration calibration;
  set_camera_matrix(calibration.left, left);
  set_camera_matrix(calibration.right, right);

  const double length = baseline.number() / 1000;
  const RectifiedViews views =
      views_of(calibration.left, calibration.right, calibration.left.focal_x * length);
  Rectification rectification = rectification_from(views, left, right);
  rectification.baseline = length;
  check_translation({-length, 0, 0}, baseline, "; it is in millimeters");

  const std::optional<Entry> offset = file.find("doffs");
  constexpr double kRounding = 0.1;
  if (offset && std::abs(offset->number() - rectification.principal_offset()) > kRounding) {
    offset->fail("is " + number_text(offset->number()) + ", but cam0 and cam1 state " +
                 number_text(rectification.principal_offset()));
  }
  CameraCalibration size;
  size.width = request.width;
  size.height = request.height;
  if (file.find("width") || file.find("height")) {
    set_size(size, file.at("width"), file.at("height"));
  }
  rectification.width = size.width;
  rectification.height = size.height;
  calibration = rectified_cameras(rectification);
  calibration.format = "Middlebury";
  note_length(calibration, "multiply baseline by 1000 if it is in meters", "millimeters");
  return calibration;
}

}  // namespace mtstereo::formats
