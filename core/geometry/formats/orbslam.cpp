// SPDX-License-Identifier: LGPL-2.1-or-later
// ORB-SLAM2 and ORB-SLAM3: Camera1.*, Camera2.* and Stereo.T_c1_c2, which moves points from the
// right camera to the left one; or one camera and a baseline for views that are rectified.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "geometry/formats/opencv_entries.hpp"
#include "geometry/formats/parts.hpp"
#include "geometry/formats/readers.hpp"

namespace mtstereo::formats {
namespace {

Entry camera_entry(const Entry& file, const std::string& camera, const char* name) {
  return file.at(camera + "." + name);
}

/// Coefficients; those that have no entry are 0.
std::vector<double> coefficients(const Entry& file, const std::string& camera,
                                 std::initializer_list<const char*> names) {
  std::vector<double> values;
  for (const char* name : names) {
    const std::optional<Entry> entry = file.find(camera + "." + name);
    values.push_back(entry ? entry->number() : 0);
  }
  return values;
}

CameraCalibration read_camera(const Entry& file, const std::string& name, bool fisheye) {
  CameraCalibration camera;
  const Entry focal = camera_entry(file, name, "fx");
  set_camera_matrix(
      camera, focal,
      {focal.number(), 0, camera_entry(file, name, "cx").number(), 0,
       camera_entry(file, name, "fy").number(), camera_entry(file, name, "cy").number(), 0, 0, 1});
  if (fisheye) {
    (void)camera_entry(file, name, "k1").number();
    camera.lens = LensModel::kFisheye;
    camera.coefficients = coefficients(file, name, {"k1", "k2", "k3", "k4"});
    return camera;
  }
  camera.coefficients = coefficients(file, name, {"k1", "k2", "p1", "p2", "k3"});
  const bool none = std::all_of(camera.coefficients.begin(), camera.coefficients.end(),
                                [](double value) { return value == 0; });
  if (none) camera.coefficients.clear();
  camera.lens = none ? LensModel::kNone : LensModel::kPlumbBob;
  return camera;
}

/// Both cameras have the same size.
void read_size(const Entry& file, const Request& request, CameraCalibration& camera) {
  const std::optional<Entry> width = file.find("Camera.width");
  const std::optional<Entry> height = file.find("Camera.height");
  camera.width = request.width;
  camera.height = request.height;
  if (width && height) set_size(camera, *width, *height);
}

/// A pair that is rectified already: one camera and the baseline.
StereoCalibration read_rectified(const Entry& file, const CameraCalibration& camera) {
  const std::optional<Entry> length = file.find("Stereo.b");
  const std::optional<Entry> product = file.find("Camera.bf");
  if (!length && !product) {
    file.fail(
        "states one camera only: there is neither Camera2.fx with Stereo.T_c1_c2, nor LEFT.K with "
        "RIGHT.K, nor Stereo.b or Camera.bf");
  }
  if (camera.lens != LensModel::kNone) {
    file.fail(
        "states one camera, and it has distortion; for raw views, Camera2.fx and Stereo.T_c1_c2, "
        "or LEFT.K and RIGHT.K are needed");
  }
  // Camera.bf is sometimes an entry of P of the right camera, which is negative.
  const double baseline = length ? length->number() : std::abs(product->number()) / camera.focal_x;
  Rectification rectification =
      rectification_from(views_of(camera, camera, camera.focal_x * baseline), file, file);
  rectification.baseline = baseline;
  rectification.width = camera.width;
  rectification.height = camera.height;
  check_translation({-baseline, 0, 0}, length ? *length : *product, "; it must be in meters");
  return rectified_cameras(rectification);
}

/// From the axes of the left camera to those of the right one.
Motion read_motion(const Entry& file, const Entry& pose) {
  // Tlr of older files has no last row.
  constexpr std::size_t kThreeRows = 12;
  std::vector<double> values = pose.numbers();
  if (values.size() == kThreeRows) values.insert(values.end(), {0, 0, 0, 1});
  Value matrix;
  matrix.kind = Value::Kind::kList;
  for (const double value : values) {
    matrix.items.emplace_back();
    matrix.items.back().text = number_text(value);
  }
  return motion_from(Entry(matrix, file.file(), pose.name())).inverse();
}

}  // namespace

bool is_orbslam(const Entry& file) {
  if (!file.find_any({"Camera1.fx", "Camera.fx"})) return false;
  const PairEntries raw = OpenCvEntries({file}).find_pair();
  return !raw.left_matrix || !raw.right_matrix;
}

StereoCalibration read_orbslam(const Entry& file, const Request& request) {
  no_selection(file, request.selection);
  const std::optional<Entry> type = file.find("Camera.type");
  const std::string model = type ? type->text() : "PinHole";
  if (model != "PinHole" && model != "KannalaBrandt8" && model != "Rectified") {
    type->fail("is '" + printable(model) +
               "', which is not supported; calibrate with PinHole, KannalaBrandt8 or Rectified");
  }
  const bool fisheye = model == "KannalaBrandt8";
  const std::string left = file.find("Camera1.fx") ? "Camera1" : "Camera";
  StereoCalibration calibration;
  calibration.left = read_camera(file, left, fisheye);
  read_size(file, request, calibration.left);
  const bool depth = file.find_any({"RGBD.DepthMapFactor", "DepthMapFactor"}).has_value();
  if (model == "Rectified" || !file.find("Camera2.fx")) {
    if (depth && model != "Rectified") {
      file.fail("is of a camera for color and depth (DepthMapFactor), not of a stereo pair");
    }
    calibration = read_rectified(file, calibration.left);
  } else {
    calibration.right = read_camera(file, "Camera2", fisheye);
    read_size(file, request, calibration.right);
    const std::optional<Entry> pose = file.find_any({"Stereo.T_c1_c2", "Tlr"});
    if (!pose) file.fail("there is no entry Stereo.T_c1_c2 (position of the right camera)");
    const Motion motion = read_motion(file, *pose);
    check_translation(motion.translation, *pose, "; it must be in meters");
    set_motion(calibration, motion);
  }
  calibration.format = "ORB-SLAM";
  return calibration;
}

}  // namespace mtstereo::formats
