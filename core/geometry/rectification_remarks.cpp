// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "base/guard.hpp"
#include "geometry/lens.hpp"
#include "geometry/view_coverage.hpp"
#include "mtstereo/geometry/rectification.hpp"
#include "mtstereo/geometry/rig.hpp"

namespace mtstereo {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
/// A smaller part of an image is not worth a word.
constexpr double kFewPixels = 1e-3;
/// A view that the camera fills less gives next to no matches.
constexpr double kNearlyEmpty = 0.25;
/// A field of view that a plane cannot show without shrinking its middle [degrees].
constexpr double kWideField = 140;

std::string whole(double value) { return std::to_string(std::lround(value)); }

std::string percent(double part) {
  if (part > 0 && part < 0.01) return "less than 1 %";
  return whole(100 * part) + " %";
}

/// The angle between the directions of two positions [degrees]; 0 if there are none.
double angle_between(const Lens& lens, double u0, double v0, double u1, double v1) {
  const Vector3 a = lens.direction(u0, v0);
  const Vector3 b = lens.direction(u1, v1);
  const double middle_u = (u0 + u1) / 2;
  const double middle_v = (v0 + v1) / 2;
  const Vector3 m = lens.direction(middle_u, middle_v);
  const auto dot = [](const Vector3& p, const Vector3& q) {
    return std::clamp(p[0] * q[0] + p[1] * q[1] + p[2] * q[2], -1.0, 1.0);
  };
  const double angle = (std::acos(dot(a, m)) + std::acos(dot(m, b))) / kDegree;
  return std::isnan(angle) ? 0 : angle;
}

void note_lens(std::vector<RectificationRemark>& remarks, const CameraCalibration& camera,
               const std::string& name) {
  const double part = uncovered_part(camera);
  if (part < kFewPixels) return;
  remarks.push_back({"The lens model of the " + name + " camera ends " +
                         whole(Lens(camera).widest_angle() / kDegree) +
                         " degrees from its axis, where it turns back: " + percent(part) +
                         " of its image is beyond that and is left out.",
                     false});
}

void note_field(std::vector<RectificationRemark>& remarks, const CameraCalibration& camera,
                const Rectification& rectification) {
  const Lens lens(camera);
  const double right = camera.width - 1;
  const double bottom = camera.height - 1;
  const double across = angle_between(lens, 0, bottom / 2, right, bottom / 2);
  const double down = angle_between(lens, right / 2, 0, right / 2, bottom);
  const RigFigures figures = rig_figures(rectification);
  const bool wider = across > kWideField && across > figures.horizontal_field + 1;
  const bool higher = down > kWideField && down > figures.vertical_field + 1;
  if (!wider && !higher) return;
  remarks.push_back({"The cameras see " + whole(across) + " x " + whole(down) +
                         " degrees, the rectified views show " + whole(figures.horizontal_field) +
                         " x " + whole(figures.vertical_field) +
                         "; what is farther from the axis is cut off.",
                     false});
}

void note_empty(std::vector<RectificationRemark>& remarks, double part, int width,
                const std::string& name) {
  if (part >= kNearlyEmpty) return;
  remarks.push_back({"The " + name + " camera fills only " + percent(part) +
                         " of its rectified view (" + whole(part * width) + " of " +
                         std::to_string(width) +
                         " columns on average): nothing can be matched in the rest. Unless alpha "
                         "is near 1, the calibration is that of other cameras or of another size.",
                     true});
}

}  // namespace

Result<std::vector<RectificationRemark>> rectification_remarks(
    const StereoCalibration& calibration, const Rectification& rectification) noexcept {
  return guarded([&]() -> Result<std::vector<RectificationRemark>> {
    std::vector<RectificationRemark> remarks;
    note_lens(remarks, calibration.left, "left");
    note_lens(remarks, calibration.right, "right");
    note_field(remarks, calibration.left, rectification);
    note_empty(remarks, seen_part(calibration, rectification, Rectifier::Side::kLeft),
               rectification.width, "left");
    note_empty(remarks, seen_part(calibration, rectification, Rectifier::Side::kRight),
               rectification.width, "right");
    return remarks;
  });
}

}  // namespace mtstereo
