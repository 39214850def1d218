// SPDX-License-Identifier: LGPL-2.1-or-later
#include "geometry/rectified_frame.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "geometry/lens.hpp"
#include "geometry/rotate.hpp"

namespace mtstereo {
namespace {

constexpr int kSamples = 64;  // per side of an image
/// No direction that is farther from the rectified axis is shown: the tangent of 90 degrees is
/// infinite.
constexpr double kWidestAngle = 85 * kDegree;  // [rad]
/// With alpha = 0, no side of the images is farther from the axis. Wider images would show the
/// middle at less than half of the camera's scale.
constexpr double kWidestCrop = 70 * kDegree;  // [rad]

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

/// A point of the plane at the distance 1.
struct PlanePoint {
  double x = 0;
  double y = 0;
};

/// The border of the part of an image that can be rectified: where the lens model knows the
/// directions, and these are not too far from the rectified axis.
class ViewBorder {
 public:
  ViewBorder(const CameraCalibration& camera, const Matrix3& rotation)
      : lens_(camera),
        rotation_(rotation),
        width_(camera.width - 1),
        height_(camera.height - 1),
        start_x_(std::clamp(camera.center_x, 0.0, width_)),
        start_y_(std::clamp(camera.center_y, 0.0, height_)) {}

  /// The point of the plane that a position of the image shows, if it can be rectified.
  std::optional<PlanePoint> at(double u, double v) const {
    const Vector3 ray = rotate(rotation_, lens_.direction(u, v));
    const double angle = std::atan2(std::hypot(ray[0], ray[1]), ray[2]);
    if (!(angle < kWidestAngle)) return std::nullopt;  // also NaN
    return PlanePoint{ray[0] / ray[2], ray[1] / ray[2]};
  }
  /// The point for a position of the image, or the farthest one on the way from the principal point
  /// to it that can be rectified.
  PlanePoint nearest_to(double u, double v) const;
  PlanePoint middle() const { return nearest_to(width_ / 2, height_ / 2); }

  /// Why not even the principal point can be rectified, or an empty text. Nothing else may be asked
  /// for then.
  std::string problem() const;
  /// The rectangles inside of and around the border.
  void measure(Bounds& inner, Bounds& outer) const;

 private:
  Lens lens_;
  Matrix3 rotation_;
  double width_;
  double height_;
  double start_x_;  ///< the principal point, or what is nearest to it in the image
  double start_y_;
};

std::string ViewBorder::problem() const {
  if (at(start_x_, start_y_)) return {};
  const Vector3 ray = rotate(rotation_, lens_.direction(start_x_, start_y_));
  const double angle = std::atan2(std::hypot(ray[0], ray[1]), ray[2]);
  if (std::isnan(angle)) {
    return "has a lens model that cannot be inverted, not even at the principal point: the "
           "coefficients are wrong or belong to another model";
  }
  return "looks " + std::to_string(std::lround(angle / kDegree)) +
         " degrees away from the common direction of both cameras; both must look in about the "
         "same direction";
}

PlanePoint ViewBorder::nearest_to(double u, double v) const {
  if (const auto point = at(u, v)) return *point;
  PlanePoint last = *at(start_x_, start_y_);
  double inside = 0;
  double outside = 1;
  constexpr int kHalvings = 40;
  for (int i = 0; i < kHalvings; ++i) {
    const double part = (inside + outside) / 2;
    if (const auto point = at(start_x_ + (u - start_x_) * part, start_y_ + (v - start_y_) * part)) {
      last = *point;
      inside = part;
    } else {
      outside = part;
    }
  }
  return last;
}

void ViewBorder::measure(Bounds& inner, Bounds& outer) const {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  const double crop = std::tan(kWidestCrop);
  inner = {-crop, -crop, crop, crop};
  outer = {kFar, kFar, -kFar, -kFar};
  for (int i = 0; i <= kSamples; ++i) {
    const double part = static_cast<double>(i) / kSamples;
    const PlanePoint left = nearest_to(0, height_ * part);
    const PlanePoint right = nearest_to(width_, height_ * part);
    const PlanePoint top = nearest_to(width_ * part, 0);
    const PlanePoint bottom = nearest_to(width_ * part, height_);
    for (const PlanePoint& point : {left, right, top, bottom}) {
      outer = {std::min(outer.left, point.x), std::min(outer.top, point.y),
               std::max(outer.right, point.x), std::max(outer.bottom, point.y)};
    }
    inner = {std::max(inner.left, left.x), std::max(inner.top, top.y),
             std::min(inner.right, right.x), std::min(inner.bottom, bottom.y)};
  }
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

/// The frame for an alpha of 0 to 1; std::nullopt if the views have no common rectangle.
std::optional<RectifiedFrame> crop_views(const std::array<ViewBorder, 2>& views,
                                         const Rectification& rotations,
                                         const RectificationOptions& options) {
  std::array<Bounds, 2> inner;
  std::array<Bounds, 2> outer;
  for (std::size_t i = 0; i < 2; ++i) views[i].measure(inner[i], outer[i]);
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
  RectifiedFrame frame;
  frame.focal_length = crop * (1 - alpha) + all * alpha;
  const auto center = [&](double in_crop, double in_all, double length) {
    return length / 2 - frame.focal_length * (in_crop * (1 - alpha) + in_all * alpha);
  };
  frame.left_center_x = center(inner[0].center_x(), outer[0].center_x(), width);
  frame.right_center_x = center(inner[1].center_x(), outer[1].center_x(), width);
  frame.center_y = center(inner[0].center_y(), outer[0].center_y(), height);
  return frame;
}

}  // namespace

Result<RectifiedFrame> frame_views(const StereoCalibration& calibration,
                                   const Rectification& rotations,
                                   const RectificationOptions& options) {
  const auto refused = [](const std::string& reason) {
    return Error{ErrorCode::kInvalidCalibration,
                 "The calibration cannot be rectified: " + reason + "."};
  };
  const std::array<ViewBorder, 2> views = {ViewBorder(calibration.left, rotations.left_rotation),
                                           ViewBorder(calibration.right, rotations.right_rotation)};
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string problem = views[i].problem();
    if (!problem.empty())
      return refused(i == 0 ? "the left camera " + problem : "the right camera " + problem);
  }
  std::optional<RectifiedFrame> frame;
  if (options.alpha == kKeepScale) {
    frame = keep_scale(calibration, rotations, {views[0].middle(), views[1].middle()},
                       options.zero_disparity);
  } else {
    frame = crop_views(views, rotations, options);
  }
  if (!frame) return refused(kNoCommonPart);
  if (!frame->is_usable()) return refused("its values are too large or too small");
  return *frame;
}

}  // namespace mtstereo
