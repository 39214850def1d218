// SPDX-License-Identifier: LGPL-2.1-or-later
// KITTI: calib_cam_to_cam.txt of the raw data, with the cameras as they were calibrated (to camera
// 00) and as rectified, and calib.txt of the odometry and object data, with projections only.
// DrivingStereo names its cameras 101 and 103.
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "geometry/formats/parts.hpp"
#include "geometry/formats/readers.hpp"

namespace mtstereo::formats {
namespace {

/// A pair of cameras that are side by side.
struct Pair {
  const char* name;
  int left, right;
};
/// The default first.
constexpr std::array<Pair, 2> kPairs = {{{"color", 2, 3}, {"gray", 0, 1}}};

/// The pair that a selection names, if there is one.
std::optional<Pair> selected(const Entry& file, const std::string& selection) {
  if (selection.empty()) return std::nullopt;
  for (const Pair& pair : kPairs) {
    if (selection == pair.name) return pair;
  }
  file.fail("'#" + printable(selection) + "' selects no cameras; '#gray' or '#color' is needed");
}

/// "K_02".
Entry at(const Entry& file, const char* name, int camera) {
  return file.at(std::string(name) + "_0" + std::to_string(camera));
}
bool has(const Entry& file, const char* name, int camera) {
  return file.find(std::string(name) + "_0" + std::to_string(camera)).has_value();
}

/// A size of the file; 0x0 if it is not there.
CameraCalibration size_of(const Entry& file, const char* name, int camera) {
  CameraCalibration size;
  if (has(file, name, camera)) set_size(size, at(file, name, camera));
  return size;
}

bool is_size(const CameraCalibration& size, const Request& request) {
  return request.width > 0 && size.width == request.width && size.height == request.height;
}

Pair choose_pair(const Entry& file, const Request& request) {
  if (const std::optional<Pair> pair = selected(file, request.selection)) return *pair;
  for (const char* name : {"S", "S_rect"}) {
    for (const Pair& pair : kPairs) {
      if (is_size(size_of(file, name, pair.left), request)) return pair;
    }
  }
  for (const Pair& pair : kPairs) {
    if (has(file, "K", pair.left) || has(file, "S", pair.left)) return pair;
  }
  file.fail(
      "states no cameras (S_02, K_02 and others): KITTI has them in calib_cam_to_cam.txt; of other "
      "rectified views write the projections P_rect to a file, left as P0: and right as P1:");
}

CameraCalibration read_camera(const Entry& file, int camera) {
  CameraCalibration calibration = size_of(file, "S", camera);
  (void)at(file, "S", camera);
  set_camera_matrix(calibration, at(file, "K", camera));
  set_lens(calibration, LensModel::kPlumbBob, at(file, "D", camera));
  return calibration;
}

/// DrivingStereo: rectified views. They are no rectification if their pixels are not square.
StereoCalibration read_driving_stereo(const Entry& file, const Request& request) {
  no_selection(file, request.selection);
  const Entry p1 = file.at("P_rect_101", "projection of the left camera");
  const Entry p2 = file.at("P_rect_103", "projection of the right camera");
  const auto camera_of = [&](const Entry& projection) {
    CameraCalibration camera;
    camera.width = request.width;
    camera.height = request.height;
    if (const std::optional<Entry> size = file.find("S_rect_101")) set_size(camera, *size);
    const std::vector<double> p = projection.numbers(12, "a 3x4 projection");
    set_camera_matrix(camera, projection, {p[0], p[1], p[2], p[4], p[5], p[6], p[8], p[9], p[10]});
    return camera;
  };
  StereoCalibration calibration;
  calibration.format = "DrivingStereo";
  calibration.left = camera_of(p1);
  calibration.right = camera_of(p2);
  const double left = p1.numbers()[3] / calibration.left.focal_x;
  Motion motion;
  motion.translation.x() = p2.numbers()[3] / calibration.right.focal_x - left;
  check_translation(motion.translation, p2, "");
  set_motion(calibration, motion);
  return calibration;
}

/// From the axes of camera 00.
Motion read_motion(const Entry& file, int camera) {
  Motion motion;
  motion.rotation = rotation_from(at(file, "R", camera));
  const std::vector<double> t = at(file, "T", camera).numbers(3, "a vector");
  motion.translation = {t[0], t[1], t[2]};
  return motion;
}

/// "09-Jan-2012 13:57:47" in ISO 8601.
std::string date_of(const Entry& file) {
  const std::optional<Entry> entry = file.find("calib_time");
  if (!entry) return {};
  const std::string text = entry->text();
  constexpr std::string_view kMonths = "JanFebMarAprMayJunJulAugSepOctNovDec";
  if (text.size() != 20 || text[2] != '-' || text[6] != '-' || text[11] != ' ') return {};
  const std::size_t month = kMonths.find(text.substr(3, 3));
  if (month == std::string_view::npos || month % 3 != 0) return {};
  std::string number = std::to_string(month / 3 + 1);
  if (number.size() == 1) number.insert(0, 1, '0');
  return printable(text.substr(7, 4) + "-" + number + "-" + text.substr(0, 2) + "T" +
                   text.substr(12));
}

}  // namespace

StereoCalibration read_kitti_raw(const Entry& file, const Request& request) {
  if (file.find("P_rect_101") || file.find("P_rect_103")) return read_driving_stereo(file, request);
  const Pair pair = choose_pair(file, request);
  StereoCalibration calibration;
  calibration.left = read_camera(file, pair.left);
  calibration.right = read_camera(file, pair.right);
  const Motion motion = read_motion(file, pair.right).after(read_motion(file, pair.left).inverse());
  check_translation(motion.translation, at(file, "T", pair.right), "");
  set_motion(calibration, motion);
  const Entry p1 = at(file, "P_rect", pair.left);
  const Entry p2 = at(file, "P_rect", pair.right);
  constexpr const char* kShape = "a 3x4 projection";
  RectifiedViews views;
  views.left_rotation = rotation_from(at(file, "R_rect", pair.left));
  views.right_rotation = rotation_from(at(file, "R_rect", pair.right));
  views.left_projection = p1.numbers(12, kShape);
  views.right_projection = p2.numbers(12, kShape);
  // The cameras 02 and 03 have a place relative to camera 00 in all three rows.
  views.left_projection[11] = views.right_projection[11] = 0;
  calibration.rectification = rectification_from(views, p1, p2);
  CameraCalibration size;
  set_size(size, at(file, "S_rect", pair.left));
  calibration.rectification->width = size.width;
  calibration.rectification->height = size.height;
  // Video of the size of the rectified images is rectified already.
  if (is_size(size, request) && !is_size(calibration.left, request)) {
    calibration = rectified_cameras(*calibration.rectification);
  }
  calibration.format = "KITTI calib_cam_to_cam";
  calibration.date = date_of(file);
  return calibration;
}

StereoCalibration read_kitti_odometry(const Entry& file, const Request& request) {
  std::optional<Entry> p1;
  std::optional<Entry> p2;
  const std::optional<Pair> wanted = selected(file, request.selection);
  if (file.is_list()) {
    const std::vector<Entry> lines = file.list();
    if (lines.size() != 2 && lines.size() != 4) {
      file.fail("there are " + std::to_string(lines.size()) +
                " lines of numbers; two projections, or four (P0 to P3), are needed");
    }
    const std::size_t left = lines.size() == 2 || (wanted && wanted->left == 0) ? 0 : 2;
    p1.emplace(lines[left].value(), file.file(), "line " + std::to_string(left + 1));
    p2.emplace(lines[left + 1].value(), file.file(), "line " + std::to_string(left + 2));
  } else {
    const Pair pair = wanted ? *wanted : file.find("P2") ? kPairs[0] : kPairs[1];
    p1 = file.at("P" + std::to_string(pair.left), "projection of the left camera");
    p2 = file.at("P" + std::to_string(pair.right), "projection of the right camera");
  }
  constexpr const char* kShape = "a 3x4 projection";
  RectifiedViews views;
  views.left_projection = p1->numbers(12, kShape);
  views.right_projection = p2->numbers(12, kShape);
  views.left_projection[11] = views.right_projection[11] = 0;
  Rectification rectification = rectification_from(views, *p1, *p2);
  check_translation({-rectification.baseline, 0, 0}, *p2, "");
  rectification.width = request.width;
  rectification.height = request.height;
  StereoCalibration calibration = rectified_cameras(rectification);
  calibration.format = "KITTI odometry";
  return calibration;
}

}  // namespace mtstereo::formats
