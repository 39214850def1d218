// SPDX-License-Identifier: LGPL-2.1-or-later
// Lists of cameras on a body: OKVIS (T_SC), and SVO, maplab and Kalibr's exporter (T_B_C). Both
// poses move points from a camera to the body; that of Spectacular AI (imuToCamera) moves them
// back.
#include <optional>
#include <vector>

#include "geometry/formats/parts.hpp"
#include "geometry/formats/readers.hpp"

namespace mtstereo::formats {
namespace {

/// The list: at the top of the file, or for maplab in one of its sensors.
std::optional<Entry> cameras_of(const Entry& file) {
  std::optional<Entry> cameras = file.find("cameras");
  const std::optional<Entry> sensors = file.find("sensors");
  if (cameras || !sensors || !sensors->is_list()) return cameras;
  for (const Entry& sensor : sensors->list()) {
    if (!cameras) cameras = sensor.find("cameras");
  }
  return cameras;
}

CameraCalibration read_okvis(const Entry& entry) {
  CameraCalibration camera;
  set_size(camera, entry.at("image_dimension"));
  const Entry focal = entry.at("focal_length");
  const std::vector<double> f = focal.numbers(2, "fx, fy");
  const std::vector<double> c = entry.at("principal_point").numbers(2, "cx, cy");
  set_camera_matrix(camera, focal, {f[0], 0, c[0], 0, f[1], c[1], 0, 0, 1});
  set_lens(camera, lens_model(entry.at("distortion_type")), entry.at("distortion_coefficients"));
  return camera;
}

CameraCalibration read_spectacular_ai(const Entry& entry) {
  CameraCalibration camera;
  const std::optional<Entry> width = entry.find("imageWidth"), height = entry.find("imageHeight");
  if (width && height) set_size(camera, *width, *height);
  const auto number = [&](const char* name) { return entry.at(name).number(); };
  set_camera_matrix(camera, entry,
                    {number("focalLengthX"), 0, number("principalPointX"), 0,
                     number("focalLengthY"), number("principalPointY"), 0, 0, 1});
  const Entry model = entry.at("model", "the lens model");
  LensModel lens = LensModel::kNone;
  if (model.text() == "kannala-brandt4") {
    lens = LensModel::kFisheye;
  } else if (model.text() == "brown-conrady") {
    lens = LensModel::kPlumbBob;
  } else if (model.text() != "pinhole") {
    model.fail("is '" + printable(model.text()) +
               "', only pinhole, kannala-brandt4 and brown-conrady are supported");
  }
  const std::optional<Entry> coefficients = entry.find("distortionCoefficients");
  if (coefficients || lens != LensModel::kNone) {
    set_lens(camera, lens, entry.at("distortionCoefficients"));
  }
  return camera;
}

CameraCalibration read_listed_camera(const Entry& entry) {
  if (entry.find("T_SC")) return read_okvis(entry);
  if (entry.find("imuToCamera")) return read_spectacular_ai(entry);
  CameraCalibration camera;
  const Entry inner = entry.at("camera");
  const Entry type = inner.at("type");
  if (type.text() != "pinhole") {
    type.fail("is '" + printable(type.text()) + "', only pinhole is supported");
  }
  set_size(camera, inner.at("image_width"), inner.at("image_height"));
  set_intrinsics(camera, inner.at("intrinsics"));
  const Entry distortion = inner.at("distortion");
  set_lens(camera, lens_model(distortion.at("type")), distortion.at("parameters"));
  return camera;
}

Entry pose_of(const Entry& camera) {
  const std::optional<Entry> pose = camera.find_any({"imuToCamera", "T_SC"});
  return pose ? *pose : camera.at("T_B_C", "the position on the body");
}

Motion to_body(const Entry& camera) {
  const Motion motion = motion_from(pose_of(camera));
  return camera.find("imuToCamera") ? motion.inverse() : motion;
}

}  // namespace

bool is_camera_list(const Entry& file) {
  const std::optional<Entry> cameras = cameras_of(file);
  if (!cameras || !cameras->is_list() || cameras->value().items.empty()) return false;
  return cameras->list().front().find_any({"T_SC", "T_B_C", "imuToCamera"}).has_value();
}

StereoCalibration read_camera_list(const Entry& file, const Request& request) {
  const std::vector<Entry> cameras = cameras_of(file).value().list();
  const CameraPair pair = selected_cameras(file, request.selection, cameras.size());
  StereoCalibration calibration;
  calibration.format = "camera list";
  calibration.left = read_listed_camera(cameras[pair.left]);
  calibration.right = read_listed_camera(cameras[pair.right]);
  const Motion motion = to_body(cameras[pair.right]).inverse().after(to_body(cameras[pair.left]));
  check_translation(motion.translation, pose_of(cameras[pair.right]), "; it must be in meters");
  set_motion(calibration, motion);
  return calibration;
}

}  // namespace mtstereo::formats
