// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/guard.hpp"
#include "geometry/lens.hpp"
#include "geometry/view_coverage.hpp"
#include "mtstereo/geometry/rig.hpp"

namespace mtstereo {
namespace {

/// A smaller part of an image is not worth a word.
constexpr double kFewPixels = 1e-3;
/// A lens model that turns back before most of the image is not that of the camera.
constexpr double kMostPixels = 0.5;
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

/// Collects the remarks on the views of one rectification.
class Remarks {
 public:
  Remarks(const StereoCalibration& calibration, const Rectification& rectification)
      : calibration_(calibration), rectification_(rectification) {}

  std::vector<RectificationRemark> all() {
    for (const Side side : {Side::kLeft, Side::kRight}) {
      note_lens(side);
      note_field(side);
      note_empty(side);
    }
    return std::move(remarks_);
  }

 private:
  using Side = Rectifier::Side;

  const CameraCalibration& camera(Side side) const {
    return side == Side::kLeft ? calibration_.left : calibration_.right;
  }
  static std::string name_of(Side side) { return side == Side::kLeft ? "left" : "right"; }
  void note_lens(Side side);
  void note_field(Side side);
  void note_empty(Side side);

  const StereoCalibration& calibration_;
  const Rectification& rectification_;
  std::vector<RectificationRemark> remarks_;
};

void Remarks::note_lens(Side side) {
  const double part = uncovered_part(camera(side));
  if (part < kFewPixels) return;
  const bool most = part >= kMostPixels;
  remarks_.push_back({side,
                      "The lens model of the " + name_of(side) + " camera ends " +
                          whole(Lens(camera(side)).widest_angle() / kDegree) +
                          " degrees from its axis, where it turns back: " + percent(part) +
                          " of its image is beyond that and is left out." +
                          (most ? " The distortion is hardly that of this camera; calibrate it "
                                  "with views that cover its image."
                                : ""),
                      most, true});
}

void Remarks::note_field(Side side) {
  const Lens lens(camera(side));
  const double right = camera(side).width - 1;
  const double bottom = camera(side).height - 1;
  const double across = angle_between(lens, 0, bottom / 2, right, bottom / 2);
  const double down = angle_between(lens, right / 2, 0, right / 2, bottom);
  const RigFigures figures = rig_figures(rectification_);
  const bool wider = across > kWideField && across > figures.horizontal_field + 1;
  const bool higher = down > kWideField && down > figures.vertical_field + 1;
  if (!wider && !higher) return;
  remarks_.push_back({side,
                      "The " + name_of(side) + " camera sees " + whole(across) + " x " +
                          whole(down) + " degrees, the rectified views show " +
                          whole(figures.horizontal_field) + " x " + whole(figures.vertical_field) +
                          "; what is farther from the axis is cut off.",
                      false});
}

void Remarks::note_empty(Side side) {
  const double part = seen_part(calibration_, rectification_, side);
  if (part >= kNearlyEmpty) return;
  remarks_.push_back(
      {side,
       "The " + name_of(side) + " camera fills only " + percent(part) + " of its rectified view (" +
           whole(part * rectification_.width) + " of " + std::to_string(rectification_.width) +
           " columns on average): nothing can be matched in the rest. Unless alpha is near 1, the "
           "calibration belongs to other cameras or another size.",
       true});
}

}  // namespace

Result<std::vector<RectificationRemark>> rectification_remarks(
    const StereoCalibration& calibration, const Rectification& rectification) noexcept {
  return guarded([&]() -> Result<std::vector<RectificationRemark>> {
    return Remarks(calibration, rectification).all();
  });
}

}  // namespace mtstereo
