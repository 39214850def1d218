// SPDX-License-Identifier: LGPL-2.1-or-later
#include "geometry/view_coverage.hpp"

#include <cmath>

#include "geometry/lens.hpp"
#include "geometry/rotate.hpp"

namespace mtstereo {
namespace {

constexpr int kColumns = 96;
constexpr int kRows = 54;

/// The share of positions, evenly in an image of this size, for which the function is true.
template <typename Function>
double share_of(int width, int height, const Function& holds) {
  int count = 0;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const double x = (column + 0.5) * width / kColumns - 0.5;
      const double y = (row + 0.5) * height / kRows - 0.5;
      if (holds(x, y)) ++count;
    }
  }
  return static_cast<double>(count) / (kColumns * kRows);
}

/// One view of a rectification.
struct View {
  const CameraCalibration& camera;
  const Matrix3& rotation;
  double center_x;
};

View view_of(const StereoCalibration& calibration, const Rectification& rectification,
             Rectifier::Side side) {
  if (side == Rectifier::Side::kLeft) {
    return {calibration.left, rectification.left_rotation, rectification.left_center_x};
  }
  return {calibration.right, rectification.right_rotation, rectification.right_center_x};
}

// Comparisons are false for NaN.
bool is_inside(double x, double y, int width, int height) {
  return x >= 0 && y >= 0 && x <= width - 1 && y <= height - 1;
}

}  // namespace

double seen_part(const StereoCalibration& calibration, const Rectification& rectification,
                 Rectifier::Side side) {
  const View view = view_of(calibration, rectification, side);
  const Lens lens(view.camera);
  return share_of(rectification.width, rectification.height, [&](double x, double y) {
    const auto [u, v] = lens.project(
        rotate_back(view.rotation, {(x - view.center_x) / rectification.focal_length,
                                    (y - rectification.center_y) / rectification.focal_length, 1}));
    return is_inside(u, v, view.camera.width, view.camera.height);
  });
}

bool shows_anything(const StereoCalibration& calibration, const Rectification& rectification,
                    Rectifier::Side side) {
  if (seen_part(calibration, rectification, side) > 0) return true;
  // An image that is small in the view may be between the samples.
  const View view = view_of(calibration, rectification, side);
  const Lens lens(view.camera);
  return share_of(view.camera.width, view.camera.height, [&](double u, double v) {
           const Vector3 ray = rotate(view.rotation, lens.direction(u, v));
           const double scale = rectification.focal_length / ray[2];
           return ray[2] > 0 &&
                  is_inside(view.center_x + scale * ray[0], rectification.center_y + scale * ray[1],
                            rectification.width, rectification.height);
         }) > 0;
}

double uncovered_part(const CameraCalibration& camera) {
  const Lens lens(camera);
  return share_of(camera.width, camera.height,
                  [&](double u, double v) { return std::isnan(lens.direction(u, v)[2]); });
}

}  // namespace mtstereo
