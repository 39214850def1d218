// SPDX-License-Identifier: LGPL-2.1-or-later
// Calibrator of calib.io: a list of cameras with the lens model of OpenCV. The transform, a
// rotation vector and a translation, moves points from the first camera to this one.
#include <optional>
#include <string>
#include <vector>

#include "geometry/calibration_remarks.hpp"
#include "geometry/formats/parts.hpp"
#include "geometry/formats/readers.hpp"

namespace mtstereo::formats {
namespace {

constexpr const char* kModel = "libCalib::CameraModelOpenCV";
constexpr const char* kUnitInCalibIo = R"(add '"length_unit": "mm",' (or cm) before "Calibration")";

/// The name of the lens model, which cameras after the first one leave out if it is the same.
std::optional<Entry> find_model(const Entry& camera) {
  const std::optional<Entry> model = camera.find("model");
  return model ? model->find("polymorphic_name") : std::nullopt;
}

void check_model(const Entry& camera) {
  const std::optional<Entry> model = find_model(camera);
  if (!model || model->text() == kModel) return;
  model->fail("is '" + printable(model->text()) + "', which is not supported; calibrate with " +
              kModel);
}

CameraCalibration read_camera(const Entry& entry) {
  check_model(entry);
  const Entry data = entry.at("model").at("ptr_wrapper").at("data");
  const Entry size = data.at("CameraModelCRT").at("CameraModelBase").at("imageSize");
  const Entry parameters = data.at("parameters");
  const auto value = [&](const char* name) { return parameters.at(name).at("val").number(); };
  CameraCalibration camera;
  set_size(camera, size.at("width"), size.at("height"));
  const double focal = value("f");
  set_camera_matrix(camera, parameters,
                    {focal, 0, value("cx"), 0, focal * value("ar"), value("cy"), 0, 0, 1});
  camera.lens = LensModel::kPlumbBob;
  for (const char* name :
       {"k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6", "s1", "s2", "s3", "s4", "tauX", "tauY"}) {
    camera.coefficients.push_back(value(name));
  }
  return camera;
}

Motion read_transform(const Entry& camera, double unit) {
  const Entry transform = camera.at("transform", "the position of the camera");
  const Entry r = transform.at("rotation");
  const Entry t = transform.at("translation");
  return {rotation_of_vector(r.at("rx").number(), r.at("ry").number(), r.at("rz").number()),
          Eigen::Vector3d(t.at("x").number(), t.at("y").number(), t.at("z").number()) * unit};
}

}  // namespace

bool is_calib_io(const Entry& file) {
  const std::optional<Entry> calibration = file.find("Calibration");
  const std::optional<Entry> cameras = calibration ? calibration->find("cameras") : std::nullopt;
  if (!cameras || !cameras->is_list() || cameras->value().items.empty()) return false;
  return find_model(cameras->list().front()).has_value();
}

StereoCalibration read_calib_io(const Entry& file, const Request& request) {
  const std::vector<Entry> cameras = file.at("Calibration").at("cameras").list();
  const CameraPair pair = selected_cameras(file, request.selection, cameras.size());
  check_model(cameras.front());
  const std::optional<Entry> unit = file.find("length_unit");
  const double meters = unit ? length_unit(*unit) : 1;
  StereoCalibration calibration;
  calibration.format = "calib.io";
  calibration.left = read_camera(cameras[pair.left]);
  calibration.right = read_camera(cameras[pair.right]);
  const Motion motion = read_transform(cameras[pair.right], meters)
                            .after(read_transform(cameras[pair.left], meters).inverse());
  check_translation(motion.translation, cameras[pair.right], std::string(": ") + kUnitInCalibIo);
  set_motion(calibration, motion);
  if (!unit) note_length(calibration, kUnitInCalibIo);
  return calibration;
}

}  // namespace mtstereo::formats
