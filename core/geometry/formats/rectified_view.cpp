// SPDX-License-Identifier: LGPL-2.1-or-later
// What programs write for rectified views: the intrinsics of one camera or of both, and the
// baseline.
#include <algorithm>
#include <optional>
#include <utility>

#include "geometry/calibration_remarks.hpp"
#include "geometry/formats/parts.hpp"
#include "geometry/formats/readers.hpp"

namespace mtstereo::formats {
namespace {

/// The baseline and its unit [m], 0 if the file states none.
std::optional<std::pair<Entry, double>> find_baseline(const Entry& file) {
  for (const auto& [name, unit] : {std::pair{"baseline_m", 1.0},
                                   {"baseline_meters", 1.0},
                                   {"baseline_cm", 0.01},
                                   {"baseline_mm", 0.001},
                                   {"baseline", 0.0},
                                   {"bl", 0.0},
                                   {"cam_bl", 0.0}}) {
    if (const std::optional<Entry> entry = file.find_any_case(name)) return {{*entry, unit}};
  }
  return std::nullopt;
}

// The names with "cam_" are those of PL-SLAM.
std::optional<Entry> find_focal_x(const Entry& entry) { return entry.find_any({"fx", "cam_fx"}); }

std::optional<Entry> find_center_x(const Entry& entry) {
  return entry.find_any({"cx", "cx0", "cx_left", "ppx", "cam_cx"});
}

std::optional<Entry> find_center_y(const Entry& entry) {
  return entry.find_any({"cy", "ppy", "cam_cy"});
}

bool has_intrinsics(const Entry& entry) {
  return (find_focal_x(entry) && find_center_x(entry) && find_center_y(entry)) || entry.find("K");
}

/// The entry with one of these names, if it is a map with intrinsics.
std::optional<Entry> find_inner(const Entry& file, std::initializer_list<std::string_view> names) {
  const std::optional<Entry> inner = file.find_any(names);
  return inner && inner->is_map() && has_intrinsics(*inner) ? inner : std::nullopt;
}

/// The map with the intrinsics of both cameras, which may be the whole file.
std::optional<Entry> find_camera(const Entry& file) {
  return has_intrinsics(file) ? file : find_inner(file, {"camera", "intrinsics", "left"});
}

std::optional<Entry> find_left_camera(const Entry& file) {
  return find_inner(file, {"left", "left_camera", "left_intrinsics"});
}

std::optional<Entry> find_right_camera(const Entry& file) {
  return find_inner(file, {"right", "right_camera", "right_intrinsics"});
}

/// Whether no number in a value differs from 0.
bool is_zero(const Value& value) {
  if (value.kind == Value::Kind::kScalar) return parse_number(value.text).value_or(0) == 0;
  return std::all_of(value.items.begin(), value.items.end(), is_zero);
}

/// A rectified view has no distortion.
void refuse_distortion(const Entry& entry) {
  for (const char* name : {"D",
                           "dist",
                           "distortion",
                           "dist_coeff",
                           "dist_coeffs",
                           "dist_coefs",
                           "distCoeffs",
                           "distortion_coeffs",
                           "distortion_coefficients",
                           "distortionCoefficients",
                           "coeffs",
                           "kc",
                           "d",
                           "k1",
                           "k2",
                           "k3",
                           "p1",
                           "p2",
                           "cam_d0",
                           "cam_d1",
                           "cam_d2",
                           "cam_d3"}) {
    const std::optional<Entry> distortion = entry.find(name);
    if (!distortion || is_zero(distortion->value())) continue;
    distortion->fail(
        "is not 0, so the views are not rectified, but the file does not state how the cameras "
        "stand; K and distortion of both cameras, R and T are needed (mtcalibrate writes them)");
  }
}

RectifiedCamera read_camera(const Entry& entry, const Request& request) {
  refuse_distortion(entry);
  CameraCalibration camera;
  camera.width = request.width;
  camera.height = request.height;
  const std::optional<Entry> width = entry.find_any({"width", "image_width", "cam_width"});
  const std::optional<Entry> height = entry.find_any({"height", "image_height", "cam_height"});
  if (width && height) set_size(camera, *width, *height);
  if (const std::optional<Entry> k = entry.find("K")) {
    set_camera_matrix(camera, *k);
    return {camera, entry};
  }
  const Entry focal = find_focal_x(entry).value_or(entry);
  const double fx = focal.number();
  const double fy = entry.find_any({"fy", "cam_fy"}).value_or(focal).number();
  const double cx = find_center_x(entry)->number(), cy = find_center_y(entry)->number();
  set_camera_matrix(camera, entry, {fx, 0, cx, 0, fy, cy, 0, 0, 1});
  return {camera, entry};
}

/// The right camera of a file that states one: the same with another center.
RectifiedCamera right_camera(const Entry& file, const RectifiedCamera& left) {
  RectifiedCamera right = left;
  for (const Entry& place : {left.k, file}) {
    if (const std::optional<Entry> center = place.find_any({"cx_right", "cx1", "cx2"})) {
      right.camera.center_x = center->number();
      break;
    }
    if (const std::optional<Entry> offset = place.find("doffs")) {
      right.camera.center_x += offset->number();
      break;
    }
  }
  return right;
}

}  // namespace

bool is_rectified_view(const Entry& file) {
  return find_baseline(file) && find_camera(file) && !file.find_any({"R", "T", "right"});
}

bool is_rectified_pair(const Entry& file) {
  return find_baseline(file) && find_left_camera(file) && find_right_camera(file) &&
         !file.find_any({"R", "T", "rotation", "translation", "extrinsics", "pose"});
}

StereoCalibration read_rectified_view(const Entry& file, const Request& request) {
  no_selection(file, request.selection);
  refuse_distortion(file);
  const bool pair = is_rectified_pair(file);
  const std::optional<Entry> camera = pair ? find_left_camera(file) : find_camera(file);
  const RectifiedCamera left = read_camera(camera.value_or(file), request);
  const RectifiedCamera right = pair ? read_camera(find_right_camera(file).value_or(file), request)
                                     : right_camera(file, left);
  const auto [length, named] = find_baseline(file).value_or(std::pair{file, 1.0});
  const std::optional<Entry> stated =
      file.find_any({"baseline_unit", "baseline_units", "length_unit", "unit", "units"});
  const double unit = named > 0 ? named : stated ? length_unit(*stated) : 1;
  StereoCalibration calibration = rectified_pair(left, right, length.number() * unit, length);
  calibration.format = "rectified view";
  if (named == 0 && !stated) note_length(calibration, "add the entry 'unit: mm' (or cm)");
  return calibration;
}

}  // namespace mtstereo::formats
