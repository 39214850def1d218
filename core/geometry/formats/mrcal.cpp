// SPDX-License-Identifier: LGPL-2.1-or-later
// mrcal: one .cameramodel per camera, a Python literal. The extrinsics move points from the
// reference to the camera: a rotation vector and a translation.
#include <string>
#include <vector>

#include "geometry/formats/parts.hpp"
#include "geometry/formats/readers.hpp"
#include "geometry/formats/syntax.hpp"

namespace mtstereo::formats {
namespace {

/// One camera of the pair.
struct MrcalCamera {
  CameraCalibration calibration;
  Motion from_reference;
};

/// The number of coefficients of a lens model.
std::size_t coefficient_count(const Entry& model) {
  const std::string name = model.text();
  if (name == "LENSMODEL_PINHOLE") return 0;
  for (const std::size_t count : {4U, 5U, 8U, 12U}) {
    if (name == "LENSMODEL_OPENCV" + std::to_string(count)) return count;
  }
  model.fail("is '" + printable(name) +
             "', which is not supported; convert both files with mrcal-convert-lensmodel to "
             "LENSMODEL_OPENCV8");
}

MrcalCamera read_mrcal_camera(const Entry& file) {
  MrcalCamera camera;
  const std::size_t count = coefficient_count(file.at("lensmodel"));
  set_size(camera.calibration, file.at("imagersize", "width and height"));
  const Entry entry = file.at("intrinsics");
  constexpr std::size_t kMatrix = 4;
  const std::vector<double> v =
      entry.numbers(kMatrix + count, "fx, fy, cx, cy and the coefficients of the lens model");
  set_camera_matrix(camera.calibration, entry, {v[0], 0, v[2], 0, v[1], v[3], 0, 0, 1});
  camera.calibration.coefficients.assign(v.begin() + kMatrix, v.end());
  camera.calibration.lens = count == 0 ? LensModel::kNone : LensModel::kPlumbBob;
  const std::vector<double> pose =
      file.at("extrinsics").numbers(6, "a rotation vector and a translation");
  camera.from_reference.rotation = rotation_of_vector(pose[0], pose[1], pose[2]);
  camera.from_reference.translation = {pose[3], pose[4], pose[5]};
  return camera;
}

}  // namespace

Value parse_mrcal(std::string text, const std::string& file) {
  // The inputs of the optimization are bytes: b'...', without any ' in them.
  constexpr std::string_view kInputs = "'optimization_inputs'";
  const std::size_t begin = text.find(kInputs);
  if (begin != std::string::npos) {
    const std::size_t open = text.find('\'', begin + kInputs.size());
    const std::size_t close = open == std::string::npos ? open : text.find('\'', open + 1);
    if (close == std::string::npos) {
      throw FileError(file + ": optimization_inputs has no end, the file is truncated");
    }
    text.replace(begin + kInputs.size(), close + 1 - begin - kInputs.size(), ": ''");
  }
  return parse_yaml(text, file);
}

StereoCalibration read_mrcal(const Entry& left_file, const Entry& right_file,
                             const Request& request) {
  no_selection(left_file, request.selection);
  const MrcalCamera left = read_mrcal_camera(left_file);
  const MrcalCamera right = read_mrcal_camera(right_file);
  StereoCalibration calibration;
  calibration.format = "mrcal";
  calibration.left = left.calibration;
  calibration.right = right.calibration;
  const Motion motion = right.from_reference.after(left.from_reference.inverse());
  check_translation(motion.translation, right_file.at("extrinsics"), "; it must be in meters");
  set_motion(calibration, motion);
  return calibration;
}

}  // namespace mtstereo::formats
