// SPDX-License-Identifier: LGPL-2.1-or-later
// VINS-Fusion: a file that names the files of its cameras, in the same folder. body_T_cam0 moves
// points from the camera to the body. OV2SLAM has the same poses, and the cameras in one file.
#include <filesystem>
#include <string>
#include <vector>

#include "geometry/formats/document.hpp"
#include "geometry/formats/parts.hpp"
#include "geometry/formats/readers.hpp"

namespace mtstereo::formats {
namespace {

namespace fs = std::filesystem;

std::vector<double> numbers_of(const Entry& map, std::initializer_list<const char*> names) {
  std::vector<double> values;
  for (const char* name : names) values.push_back(map.at(name).number());
  return values;
}

CameraCalibration read_vins_camera(const Entry& file) {
  CameraCalibration camera;
  set_size(camera, file.at("image_width"), file.at("image_height"));
  const Entry type = file.at("model_type", "the lens model");
  const std::string model = type.text();
  const Entry projection = file.at("projection_parameters");
  if (model == "PINHOLE") {
    const std::vector<double> k = numbers_of(projection, {"fx", "fy", "cx", "cy"});
    set_camera_matrix(camera, projection, {k[0], 0, k[2], 0, k[1], k[3], 0, 0, 1});
    camera.lens = LensModel::kPlumbBob;
    camera.coefficients = numbers_of(file.at("distortion_parameters"), {"k1", "k2", "p1", "p2"});
    return camera;
  }
  if (model == "KANNALA_BRANDT") {
    const std::vector<double> k = numbers_of(projection, {"mu", "mv", "u0", "v0"});
    set_camera_matrix(camera, projection, {k[0], 0, k[2], 0, k[1], k[3], 0, 0, 1});
    camera.lens = LensModel::kFisheye;
    camera.coefficients = numbers_of(projection, {"k2", "k3", "k4", "k5"});
    return camera;
  }
  if (model == "MEI") {
    const std::vector<double> k = numbers_of(projection, {"gamma1", "gamma2", "u0", "v0"});
    set_camera_matrix(camera, projection, {k[0], 0, k[2], 0, k[1], k[3], 0, 0, 1});
    set_omnidirectional(camera, file.at("mirror_parameters").at("xi"),
                        numbers_of(file.at("distortion_parameters"), {"k1", "k2", "p1", "p2"}));
    return camera;
  }
  type.fail("is '" + printable(model) +
            "', which is not supported; calibrate both cameras as PINHOLE, KANNALA_BRANDT or MEI");
}

/// The camera of a file that an entry names.
CameraCalibration read_named(const Entry& name) {
  const fs::path path = name.text();
  bool outside = path.empty() || path.is_absolute();
  for (const fs::path& part : path) outside = outside || part == "..";
  if (outside) {
    name.fail("is '" + printable(path.string()) +
              "'; the name of a file in the same folder is needed");
  }
  const Document document = parse_document((fs::path(name.file()).parent_path() / path).string());
  if (document.format != Format::kVinsCamera) {
    name.fail("names " + document.file + ", which is " + name_of(document.format) +
              "; the file of a camera with model_type is needed");
  }
  return read_vins_camera(document.entry());
}

/// The camera of OV2SLAM whose entries end in the first letter of the side.
CameraCalibration read_ov2slam_camera(const Entry& file, const std::string& side) {
  const auto at = [&](const std::string& name) { return file.at("Camera." + name); };
  const auto number = [&](const char* name) { return at(name + side.substr(0, 1)).number(); };
  CameraCalibration camera;
  set_size(camera, at(side + "_nwidth"), at(side + "_nheight"));
  set_camera_matrix(camera, at("fx" + side.substr(0, 1)),
                    {number("fx"), 0, number("cx"), 0, number("fy"), number("cy"), 0, 0, 1});
  const Entry model = at("model_" + side);
  if (model.text() != "pinhole" && model.text() != "fisheye") {
    model.fail("is '" + printable(model.text()) + "', only pinhole and fisheye are supported");
  }
  camera.lens = model.text() == "fisheye" ? LensModel::kFisheye : LensModel::kPlumbBob;
  // Those of a fisheye lens have these names, too.
  for (const char* name : {"k1", "k2", "p1", "p2"}) camera.coefficients.push_back(number(name));
  return camera;
}

}  // namespace

StereoCalibration read_ov2slam(const Entry& file, const Request& request) {
  no_selection(file, request.selection);
  StereoCalibration calibration;
  calibration.format = "OV2SLAM";
  calibration.left = read_ov2slam_camera(file, "left");
  calibration.right = read_ov2slam_camera(file, "right");
  set_motion_on_body(calibration, file.at("body_T_cam0", "position of the left camera"),
                     file.at("body_T_cam1", "position of the right camera"));
  return calibration;
}

StereoCalibration read_vins(const Entry& file, const Request& request) {
  no_selection(file, request.selection);
  StereoCalibration calibration;
  calibration.format = "VINS-Fusion";
  calibration.left = read_named(file.at("cam0_calib", "the file of the left camera"));
  calibration.right = read_named(file.at("cam1_calib", "the file of the right camera"));
  set_motion_on_body(calibration, file.at("body_T_cam0", "position of the left camera"),
                     file.at("body_T_cam1", "position of the right camera"));
  return calibration;
}

}  // namespace mtstereo::formats
