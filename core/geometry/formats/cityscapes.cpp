// SPDX-License-Identifier: LGPL-2.1-or-later
// The camera of a Cityscapes image: the rectified left view, and the baseline in meters.
#include <cmath>
#include <optional>

#include "geometry/formats/parts.hpp"
#include "geometry/formats/readers.hpp"

namespace mtstereo::formats {

bool is_cityscapes(const Entry& file) {
  const std::optional<Entry> intrinsic = file.find("intrinsic"), extrinsic = file.find("extrinsic");
  return intrinsic && extrinsic && intrinsic->find("u0") && extrinsic->find("baseline");
}

StereoCalibration read_cityscapes(const Entry& file, const Request& request) {
  no_selection(file, request.selection);
  const Entry k = file.at("intrinsic");
  const Entry length = file.at("extrinsic").at("baseline");
  const double baseline = length.number(), fy = k.at("fy").number();
  CameraCalibration camera;
  camera.width = request.width;
  camera.height = request.height;
  camera.focal_x = k.at("fx").number();
  camera.center_x = k.at("u0").number();
  camera.center_y = k.at("v0").number();
  // The data set states both for pixels that are 0.1 % higher than wide.
  constexpr double kTolerance = 0.01;
  if (!(std::abs(fy - camera.focal_x) <= kTolerance * camera.focal_x)) {
    k.fail("has the focal lengths " + number_text(camera.focal_x) + " and " + number_text(fy) +
           "; they must be equal in a rectified view");
  }
  camera.focal_y = camera.focal_x;
  StereoCalibration calibration = rectified_pair({camera, k}, {camera, k}, baseline, length);
  calibration.format = "Cityscapes";
  return calibration;
}

}  // namespace mtstereo::formats
