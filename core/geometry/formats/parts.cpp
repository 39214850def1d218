// SPDX-License-Identifier: LGPL-2.1-or-later
#include "geometry/formats/parts.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/calibration_checks.hpp"
#include "mtstereo/parameters.hpp"

namespace mtstereo::formats {
namespace {

/// Largest difference of the rows of the principal points of rectified views [px].
constexpr double kRowDifference = 0.1;

/// Checks that a projection is a rectified view's, and returns its focal length.
double focal_length_of(const std::vector<double>& p, const Entry& entry) {
  if (p[0] <= 0 || p[5] <= 0) {
    entry.fail("has the focal lengths " + number_text(p[0]) + " and " + number_text(p[5]) +
               "; the cameras are not calibrated as a pair");
  }
  if (std::abs(p[0] - p[5]) > kRelativeFocalDifference * p[0]) {
    entry.fail("has the focal lengths " + number_text(p[0]) + " and " + number_text(p[5]) +
               "; they must be equal in a rectified view, calibrate again with square pixels");
  }
  if (std::abs(p[1]) > kRelativeFocalDifference * p[0] || p[4] != 0 || p[8] != 0 || p[9] != 0 ||
      std::abs(p[10] - 1) > 1e-9) {
    entry.fail("is not the projection of a rectified view: f 0 cx t, 0 f cy 0, 0 0 1 0 is needed");
  }
  return p[0];
}

/// Width and height as two numbers, or as in "640x480".
std::vector<double> sides_of(const Entry& both) {
  const std::string text = both.is_scalar() ? both.text() : std::string();
  const std::size_t sign = text.find('x');
  if (sign == std::string::npos) return both.numbers(2, "width and height");
  const std::optional<double> width = parse_number(text.substr(0, sign));
  const std::optional<double> height = parse_number(text.substr(sign + 1));
  if (!width || !height) both.fail("is '" + printable(text) + "', as in 640x480 is needed");
  return {*width, *height};
}

}  // namespace

Motion Motion::inverse() const {
  Motion result;
  result.rotation = rotation.transpose();
  result.translation = -(result.rotation * translation);
  return result;
}

Motion Motion::after(const Motion& first) const {
  Motion result;
  result.rotation = rotation * first.rotation;
  result.translation = rotation * first.translation + translation;
  return result;
}

Eigen::Matrix3d to_eigen(const Matrix3& matrix) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(matrix.data());
}

Matrix3 to_array(const Eigen::Matrix3d& matrix) {
  Matrix3 result{};
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(result.data()) = matrix;
  return result;
}

void set_motion(StereoCalibration& calibration, const Motion& motion) {
  calibration.rotation = to_array(motion.rotation);
  calibration.translation = {motion.translation.x(), motion.translation.y(),
                             motion.translation.z()};
}

Eigen::Matrix3d rotation_of_vector(double x, double y, double z) {
  const Eigen::Vector3d vector(x, y, z);
  const double angle = vector.norm();
  if (angle == 0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix();
}

void set_camera_matrix(CameraCalibration& camera, const Entry& entry,
                       const std::vector<double>& k) {
  camera.focal_x = k[0];
  camera.focal_y = k[4];
  camera.center_x = k[2];
  camera.center_y = k[5];
  if (k[0] == 0 || k[4] == 0 || k[8] == 0) {
    entry.fail("is singular: fx = " + number_text(k[0]) + ", fy = " + number_text(k[4]) +
               "; the camera is not calibrated");
  }
  if (k[0] < 0 || k[4] < 0) {
    entry.fail("has the focal lengths " + number_text(k[0]) + " and " + number_text(k[4]) +
               "; they must be positive");
  }
  if (std::abs(k[1]) > kRelativeFocalDifference * k[0]) {
    entry.fail("has the skew " + number_text(k[1]) +
               "; calibrate without skew, or set it to 0 if it is small");
  }
  if (k[2] == 0 && k[5] == 0 && k[6] > 0 && k[7] > 0) {
    entry.fail(
        "is transposed, as MATLAB states it; transpose it, and the rotation of the right camera "
        "as well");
  }
  if (k[3] != 0 || k[6] != 0 || k[7] != 0 || std::abs(k[8] - 1) > 1e-9) {
    entry.fail("is not a camera matrix: fx 0 cx, 0 fy cy, 0 0 1 is needed");
  }
}

Eigen::Matrix3d rotation_of_quaternion(const Entry& entry, double w, double x, double y, double z) {
  const Eigen::Quaterniond turn(w, x, y, z);
  constexpr double kTolerance = 1e-3;
  if (!(std::abs(turn.norm() - 1) <= kTolerance)) {
    entry.fail("has a quaternion of the length " + number_text(turn.norm()) + ", 1 is needed");
  }
  return turn.normalized().toRotationMatrix();
}

void set_camera_matrix(CameraCalibration& camera, const Entry& entry) {
  const std::vector<double> values = entry.numbers();
  if (values.size() == 4) return set_intrinsics(camera, entry);
  set_camera_matrix(camera, entry, entry.numbers(9, "a 3x3 camera matrix"));
}

void set_intrinsics(CameraCalibration& camera, const Entry& entry) {
  const std::vector<double> v = entry.numbers(4, "fx, fy, cx, cy");
  set_camera_matrix(camera, entry, {v[0], 0, v[2], 0, v[1], v[3], 0, 0, 1});
}

void set_omnidirectional(CameraCalibration& camera, const Entry& xi,
                         const std::vector<double>& distortion) {
  const double value = xi.numbers(1, "xi").front();
  if (value < 0) xi.fail("is " + number_text(value) + "; xi must not be negative");
  camera.focal_x /= 1 + value;
  camera.focal_y /= 1 + value;
  camera.lens = LensModel::kOmnidirectional;
  camera.coefficients = {value};
  camera.coefficients.insert(camera.coefficients.end(), distortion.begin(), distortion.end());
}

LensModel lens_model(const Entry& entry) {
  constexpr std::array<std::string_view, 12> kPlumbBobWords = {
      "plumb_bob", "radtan",           "radial-tangential", "rational_polynomial",
      "pinhole",   "brown_conrady",    "thin_prism",        "rational",
      "plumb bob", "radialtangential", "radialtangential8", "perspective"};
  constexpr std::array<std::string_view, 4> kFisheyeWords = {"equidistant", "fisheye",
                                                             "kannala_brandt", "kannala_brandt4"};
  std::string word = entry.text();
  std::transform(word.begin(), word.end(), word.begin(), [](char letter) {
    return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
  });
  if (word.empty() || word == "none") return LensModel::kNone;
  if (std::find(kPlumbBobWords.begin(), kPlumbBobWords.end(), word) != kPlumbBobWords.end()) {
    return LensModel::kPlumbBob;
  }
  if (std::find(kFisheyeWords.begin(), kFisheyeWords.end(), word) != kFisheyeWords.end()) {
    return LensModel::kFisheye;
  }
  if (word == "omnidirectional") return LensModel::kOmnidirectional;
  entry.fail("is '" + printable(word) +
             "', a lens model that is not supported; calibrate with plumb_bob, "
             "rational_polynomial or equidistant");
}

void set_lens(CameraCalibration& camera, LensModel lens, const Entry& coefficients) {
  camera.coefficients = coefficients.numbers();
  const std::size_t count = camera.coefficients.size();
  camera.lens = count == 0 ? LensModel::kNone : lens;
  if (lens == LensModel::kNone) {
    const bool zero = std::all_of(camera.coefficients.begin(), camera.coefficients.end(),
                                  [](double value) { return value == 0; });
    if (!zero) coefficients.fail("has values, but the lens model is \"none\"");
    camera.coefficients.clear();
    return;
  }
  if (count == 0 || is_coefficient_count(lens, count)) return;
  coefficients.fail("has " + std::to_string(count) + " coefficients, " + coefficient_counts(lens) +
                    " are needed");
}

Eigen::Matrix3d rotation_from(const Entry& entry) {
  const std::vector<double> v = entry.numbers();
  if (v.size() == 3) return rotation_of_vector(v[0], v[1], v[2]);
  if (v.size() != 9) (void)entry.numbers(9, "a 3x3 rotation");
  Matrix3 matrix{};
  std::copy(v.begin(), v.end(), matrix.begin());
  const std::string problem = rotation_problem(matrix);
  if (!problem.empty()) entry.fail(problem);
  return to_eigen(matrix);
}

Motion motion_from(const Entry& entry) {
  const std::vector<double> v = entry.numbers(16, "a 4x4 matrix");
  const Matrix3 rotation = {v[0], v[1], v[2], v[4], v[5], v[6], v[8], v[9], v[10]};
  const std::string problem = rotation_problem(rotation);
  if (!problem.empty()) entry.fail(problem);
  if (v[12] != 0 || v[13] != 0 || v[14] != 0 || std::abs(v[15] - 1) > 1e-9) {
    entry.fail("has a last row that is not 0 0 0 1");
  }
  Motion motion;
  motion.rotation = to_eigen(rotation);
  motion.translation = {v[3], v[7], v[11]};
  return motion;
}

void set_size(CameraCalibration& camera, const Entry& width, const Entry& height) {
  camera.width = width.integer(1, kLargestImageSide);
  camera.height = height.integer(1, kLargestImageSide);
}

void set_size(CameraCalibration& camera, const Entry& both) {
  const std::vector<double> size = sides_of(both);
  for (const double side : size) {
    if (side < 1 || side > kLargestImageSide || side != std::floor(side)) {
      both.fail("is " + number_text(size[0]) + "x" + number_text(size[1]) +
                ", integers from 1 to " + std::to_string(kLargestImageSide) + " are needed");
    }
  }
  camera.width = static_cast<int>(size[0]);
  camera.height = static_cast<int>(size[1]);
}

RectifiedViews views_of(const CameraCalibration& left, const CameraCalibration& right,
                        double product) {
  const auto projection = [](const CameraCalibration& k, double offset) -> std::vector<double> {
    return {k.focal_x, 0, k.center_x, offset, 0, k.focal_y, k.center_y, 0, 0, 0, 1, 0};
  };
  RectifiedViews views;
  views.left_projection = projection(left, 0);
  views.right_projection = projection(right, -product);
  return views;
}

Rectification rectification_from(const RectifiedViews& views, const Entry& left, const Entry& right,
                                 double unit) {
  const std::vector<double>& p1 = views.left_projection;
  const std::vector<double>& p2 = views.right_projection;
  Rectification rectification;
  rectification.left_rotation = to_array(views.left_rotation);
  rectification.right_rotation = to_array(views.right_rotation);
  rectification.focal_length = focal_length_of(p1, left);
  const double right_focal = focal_length_of(p2, right);
  if (std::abs(right_focal - p1[0]) > kRelativeFocalDifference * p1[0]) {
    right.fail("has the focal length " + number_text(right_focal) + ", the left view has " +
               number_text(p1[0]) + "; the views are not rectified to each other");
  }
  if (std::abs(p1[6] - p2[6]) > kRowDifference) {
    right.fail("has the row of the principal point " + number_text(p2[6]) + ", the left view has " +
               number_text(p1[6]) + "; the views are not rectified to each other");
  }
  rectification.left_center_x = p1[2];
  rectification.right_center_x = p2[2];
  rectification.center_y = p1[6];
  rectification.baseline = (p1[3] - p2[3]) / p1[0] * unit;
  const double vertical = (p1[7] - p2[7]) / p1[0] * unit;
  if (std::abs(vertical) > std::abs(rectification.baseline)) {
    right.fail("states cameras above one another; only pairs side by side are supported");
  }
  return rectification;
}

Motion motion_of(const Rectification& rectification) {
  const Eigen::Matrix3d right = to_eigen(rectification.right_rotation);
  Motion motion;
  motion.rotation = right.transpose() * to_eigen(rectification.left_rotation);
  motion.translation = right.transpose() * Eigen::Vector3d(-rectification.baseline, 0, 0);
  return motion;
}

void check_translation(const Eigen::Vector3d& translation, const Entry& entry,
                       std::string_view hint) {
  const std::string problem =
      translation_problem({translation.x(), translation.y(), translation.z()});
  if (problem.empty()) return;
  const bool too_long = translation.norm() > kLongestBaseline;
  entry.fail("states " + problem + (too_long ? std::string(hint) : ""));
}

void set_motion_on_body(StereoCalibration& calibration, const Entry& left, const Entry& right) {
  const Motion left_to_body = motion_from(left);
  const Motion motion = motion_from(right).inverse().after(left_to_body);
  check_translation(motion.translation, right, "; it must be in meters");
  set_motion(calibration, motion);
}

double length_unit(const Entry& entry) {
  const std::string word = entry.text();
  constexpr std::array<std::pair<std::string_view, double>, 9> kUnits = {{{"m", 1},
                                                                          {"meter", 1},
                                                                          {"meters", 1},
                                                                          {"cm", 0.01},
                                                                          {"centimeters", 0.01},
                                                                          {"mm", 0.001},
                                                                          {"millimeter", 0.001},
                                                                          {"millimeters", 0.001},
                                                                          {"in", 0.0254}}};
  for (const auto& [name, unit] : kUnits) {
    if (word == name) return unit;
  }
  const std::optional<double> meters = parse_number(word);
  if (meters && *meters > 0 && std::isfinite(*meters)) return *meters;
  entry.fail("is '" + printable(word) +
             "'; m, cm, mm, in or the positive number of meters of the length 1 is needed");
}

StereoCalibration rectified_cameras(const Rectification& rectification) {
  StereoCalibration calibration;
  for (CameraCalibration* camera : {&calibration.left, &calibration.right}) {
    camera->width = rectification.width;
    camera->height = rectification.height;
    camera->focal_x = camera->focal_y = rectification.focal_length;
    camera->center_y = rectification.center_y;
  }
  calibration.left.center_x = rectification.left_center_x;
  calibration.right.center_x = rectification.right_center_x;
  calibration.translation = {-rectification.baseline, 0, 0};
  calibration.rectification = rectification;
  calibration.rectification->left_rotation = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  calibration.rectification->right_rotation = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  return calibration;
}

StereoCalibration rectified_pair(const RectifiedCamera& left, const RectifiedCamera& right,
                                 double baseline, const Entry& length) {
  const RectifiedViews views = views_of(left.camera, right.camera, left.camera.focal_x * baseline);
  Rectification rectification = rectification_from(views, left.k, right.k);
  check_translation({-baseline, 0, 0}, length, "; it must be in meters");
  rectification.baseline = baseline;
  rectification.width = left.camera.width;
  rectification.height = left.camera.height;
  return rectified_cameras(rectification);
}

Selection selected_pair(const Entry& file, const std::string& selection, std::string_view example) {
  const std::size_t at = selection.find('-');
  if (at == std::string::npos || at == 0 || at + 1 == selection.size()) {
    file.fail("'#" + printable(selection) + "' selects no cameras, write LEFT-RIGHT as in '#" +
              std::string(example) + "'");
  }
  return {selection.substr(0, at), selection.substr(at + 1)};
}

CameraPair selected_cameras(const Entry& file, const std::string& selection, std::size_t count) {
  Selection pair = {"0", "1"};
  if (!selection.empty()) {
    pair = selected_pair(file, selection, "1-0");
  } else if (count < 2) {
    file.fail("has " + std::to_string(count) + (count == 1 ? " camera" : " cameras") +
              ", 2 are needed");
  }
  const auto number_of = [&](const std::string& text) {
    constexpr std::size_t kMostCameras = 32;
    const std::size_t most = std::min(count, kMostCameras);
    for (std::size_t number = 0; number < most; ++number) {
      if (text == std::to_string(number)) return number;
    }
    file.fail("there is no camera " + printable(text) + "; there are " + std::to_string(count) +
              ", and the first one is 0");
  };
  const CameraPair cameras = {number_of(pair.left), number_of(pair.right)};
  if (cameras.left == cameras.right) {
    file.fail("the left and the right camera are both " + pair.left);
  }
  return cameras;
}

void no_selection(const Entry& file, const std::string& selection) {
  if (selection.empty()) return;
  file.fail("'#" + printable(selection) + "' selects nothing: this format has no choices");
}

}  // namespace mtstereo::formats
