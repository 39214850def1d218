// SPDX-License-Identifier: LGPL-2.1-or-later
// What programs write for rectified views: the intrinsics of one camera and the baseline.
#include <algorithm>
#include <optional>
#include <utility>

#include "geometry/formats/parts.hpp"
#include "geometry/formats/readers.hpp"

namespace mtstereo::formats {
namespace {

/// The baseline and its unit [m].
std::optional<std::pair<Entry, double>> find_baseline(const Entry& file) {
  for (const auto& [name, unit] : {std::pair{"baseline", 1.0},
                                   {"baseline_m", 1.0},
                                   {"baseline_cm", 0.01},
                                   {"baseline_mm", 0.001}}) {
    if (const std::optional<Entry> entry = file.find_any_case(name)) return {{*entry, unit}};
  }
  return std::nullopt;
}

bool has_intrinsics(const Entry& entry) {
  return (entry.find("fx") && entry.find("cx") && entry.find("cy")) || entry.find("K");
}

/// The map with the intrinsics, which may be the whole file.
std::optional<Entry> find_camera(const Entry& file) {
  if (has_intrinsics(file)) return file;
  const std::optional<Entry> inner = file.find_any({"camera", "intrinsics", "left"});
  return inner && inner->is_map() && has_intrinsics(*inner) ? inner : std::nullopt;
}

/// Whether no number in a value differs from 0.
bool is_zero(const Value& value) {
  if (value.kind == Value::Kind::kScalar) return parse_number(value.text).value_or(0) == 0;
  return std::all_of(value.items.begin(), value.items.end(), is_zero);
}

/// A rectified view has no distortion.
void refuse_distortion(const Entry& entry) {
  for (const char* name : {"D", "d", "distortion", "dist_coeffs", "distortion_coeffs",
                           "distortion_coefficients", "k1", "k2", "k3", "p1", "p2"}) {
    const std::optional<Entry> distortion = entry.find(name);
    if (!distortion || is_zero(distortion->value())) continue;
    distortion->fail(
        "is not 0, so the views are not rectified, and the file has one camera; both cameras, R "
        "and T are needed (mtcalibrate writes them)");
  }
}

CameraCalibration read_camera(const Entry& entry, const Request& request) {
  CameraCalibration camera;
  camera.width = request.width;
  camera.height = request.height;
  const std::optional<Entry> width = entry.find_any({"width", "image_width"});
  const std::optional<Entry> height = entry.find_any({"height", "image_height"});
  if (width && height) set_size(camera, *width, *height);
  if (const std::optional<Entry> k = entry.find("K")) {
    set_camera_matrix(camera, *k);
    return camera;
  }
  const double fx = entry.at("fx").number();
  const double fy = entry.find("fy").value_or(entry.at("fx")).number();
  const double cx = entry.at("cx").number(), cy = entry.at("cy").number();
  set_camera_matrix(camera, entry, {fx, 0, cx, 0, fy, cy, 0, 0, 1});
  return camera;
}

}  // namespace

bool is_rectified_view(const Entry& file) {
  return find_baseline(file) && find_camera(file) && !file.find_any({"R", "T", "right"});
}

StereoCalibration read_rectified_view(const Entry& file, const Request& request) {
  no_selection(file, request.selection);
  const Entry entry = find_camera(file).value_or(file);
  const auto [length, unit] = find_baseline(file).value_or(std::pair{file, 1.0});
  for (const Entry& place : {entry, file}) refuse_distortion(place);
  StereoCalibration calibration =
      rectified_pair(read_camera(entry, request), length.number() * unit, entry, length);
  calibration.format = "rectified view";
  return calibration;
}

}  // namespace mtstereo::formats
