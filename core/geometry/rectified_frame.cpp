// SPDX-License-Identifier: LGPL-2.1-or-later
#include "geometry/rectified_frame.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>

#include "geometry/lens.hpp"
#include "geometry/rotate.hpp"

namespace mtstereo {
namespace {

constexpr int kSamples = 64;  // per side of an image
/// A direction that is farther from the optical axis is taken for one at this angle: the tangent of
/// 90 degrees is infinite.
constexpr double kWidestAngle = 85 * std::numbers::pi / 180;  // [rad]

/// A rectangle of the plane at the distance 1.
struct Bounds {
  double left = 0;
  double top = 0;
  double right = 0;
  double bottom = 0;

  double width() const { return right - left; }
  double height() const { return bottom - top; }
  double center_x() const { return (left + right) / 2; }
  double center_y() const { return (top + bottom) / 2; }
};

/// A point of the plane, and whether the view shows it.
struct PlanePoint {
  double x = 0;
  double y = 0;
  bool too_wide = false;
};

class ViewBorder {
 public:
  ViewBorder(const CameraCalibration& camera, const Matrix3& rotation)
      : lens_(camera), rotation_(rotation), width_(camera.width - 1), height_(camera.height - 1) {}

  PlanePoint at(double u, double v) const {
    const Vector3 ray = rotate(rotation_, lens_.direction(u, v));
    const double radius = std::hypot(ray[0], ray[1]);
    const double angle = std::atan2(radius, ray[2]);
    const bool too_wide = !(angle < kWidestAngle);
    const double tangent = std::tan(too_wide ? kWidestAngle : angle);
    if (!(radius > 0)) return {0, 0, too_wide};
    return {ray[0] / radius * tangent, ray[1] / radius * tangent, too_wide};
  }
  PlanePoint middle() const { return at(width_ / 2, height_ / 2); }

  /// The rectangles inside of and around the border; false if the middle of a side is too far from
  /// the axis, or the lens model does not cover it. A corner that it does not cover is left out.
  bool measure(Bounds& inner, Bounds& outer) const;

 private:
  Lens lens_;
  Matrix3 rotation_;
  double width_;
  double height_;
};

bool ViewBorder::measure(Bounds& inner, Bounds& outer) const {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  inner = {-kFar, -kFar, kFar, kFar};
  outer = {kFar, kFar, -kFar, -kFar};
  for (int i = 0; i <= kSamples; ++i) {
    const double part = static_cast<double>(i) / kSamples;
    const PlanePoint left = at(0, height_ * part);
    const PlanePoint right = at(width_, height_ * part);
    const PlanePoint top = at(width_ * part, 0);
    const PlanePoint bottom = at(width_ * part, height_);
    for (const PlanePoint& point : {left, right, top, bottom}) {
      const bool known = !std::isnan(point.x);
      if (i == kSamples / 2 && (!known || point.too_wide)) return false;
      // The minimum of a number and NaN is the number.
      outer = {std::fmin(outer.left, point.x), std::fmin(outer.top, point.y),
               std::fmax(outer.right, point.x), std::fmax(outer.bottom, point.y)};
    }
    inner = {std::fmax(inner.left, left.x), std::fmax(inner.top, top.y),
             std::fmin(inner.right, right.x), std::fmin(inner.bottom, bottom.y)};
  }
  return true;
}

/// Both views show the same rows; with a common principal point, also the same columns.
void unite(std::array<Bounds, 2>& inner, std::array<Bounds, 2>& outer, bool columns) {
  const double top = std::max(inner[0].top, inner[1].top);
  const double bottom = std::min(inner[0].bottom, inner[1].bottom);
  const double highest = std::min(outer[0].top, outer[1].top);
  const double lowest = std::max(outer[0].bottom, outer[1].bottom);
  const double left = std::max(inner[0].left, inner[1].left);
  const double right = std::min(inner[0].right, inner[1].right);
  const double leftmost = std::min(outer[0].left, outer[1].left);
  const double rightmost = std::max(outer[0].right, outer[1].right);
  for (std::size_t i = 0; i < 2; ++i) {
    inner[i] = {columns ? left : inner[i].left, top, columns ? right : inner[i].right, bottom};
    outer[i] = {columns ? leftmost : outer[i].left, highest, columns ? rightmost : outer[i].right,
                lowest};
  }
}

RectifiedFrame keep_scale(const StereoCalibration& calibration, const Rectification& rotations,
                          const std::array<PlanePoint, 2>& middles, bool zero_disparity) {
  RectifiedFrame frame;
  const double scale_x = static_cast<double>(rotations.width) / calibration.left.width;
  const double scale_y = static_cast<double>(rotations.height) / calibration.left.height;
  frame.focal_length =
      (calibration.left.focal_y + calibration.right.focal_y) / 2 * std::min(scale_x, scale_y);
  const double x = (rotations.width - 1) / 2.0;
  const double y = (rotations.height - 1) / 2.0;
  frame.left_center_x = x - frame.focal_length * middles[0].x;
  frame.right_center_x = x - frame.focal_length * middles[1].x;
  if (zero_disparity) {
    frame.left_center_x = (frame.left_center_x + frame.right_center_x) / 2;
    frame.right_center_x = frame.left_center_x;
  }
  frame.center_y = y - frame.focal_length * (middles[0].y + middles[1].y) / 2;
  return frame;
}

}  // namespace

std::optional<RectifiedFrame> frame_views(const StereoCalibration& calibration,
                                          const Rectification& rotations,
                                          const RectificationOptions& options) {
  const std::array<ViewBorder, 2> views = {ViewBorder(calibration.left, rotations.left_rotation),
                                           ViewBorder(calibration.right, rotations.right_rotation)};
  RectifiedFrame frame;
  if (options.alpha == kKeepScale) {
    frame = keep_scale(calibration, rotations, {views[0].middle(), views[1].middle()},
                       options.zero_disparity);
    return frame.is_usable() ? std::optional(frame) : std::nullopt;
  }
  std::array<Bounds, 2> inner;
  std::array<Bounds, 2> outer;
  for (std::size_t i = 0; i < 2; ++i) {
    if (!views[i].measure(inner[i], outer[i])) return std::nullopt;
  }
  unite(inner, outer, options.zero_disparity);
  const double width = rotations.width - 1;
  const double height = rotations.height - 1;
  double crop = 0;
  double all = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 2; ++i) {
    if (!(inner[i].width() > 0) || !(inner[i].height() > 0)) return std::nullopt;
    crop = std::max({crop, width / inner[i].width(), height / inner[i].height()});
    all = std::min({all, width / outer[i].width(), height / outer[i].height()});
  }
  const double alpha = options.alpha;
  frame.focal_length = crop * (1 - alpha) + all * alpha;
  const auto center = [&](double in_crop, double in_all, double length) {
    return length / 2 - frame.focal_length * (in_crop * (1 - alpha) + in_all * alpha);
  };
  frame.left_center_x = center(inner[0].center_x(), outer[0].center_x(), width);
  frame.right_center_x = center(inner[1].center_x(), outer[1].center_x(), width);
  frame.center_y = center(inner[0].center_y(), outer[0].center_y(), height);
  return frame.is_usable() ? std::optional(frame) : std::nullopt;
}

}  // namespace mtstereo
