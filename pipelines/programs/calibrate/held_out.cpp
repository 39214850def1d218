// SPDX-License-Identifier: LGPL-2.1-or-later
#include "programs/calibrate/held_out.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "programs/calibrate/start_values.hpp"

namespace mtstereo::calibrate {
namespace {

using Eigen::Vector2d;

void add_rows(const Rig& rig, const Rectification& rectification, const BoardView& view,
              std::vector<double>& rows) {
  std::map<int, Vector2d> rights;
  for (const Observation& each : view.right) rights.emplace(each.id, each.pixel);
  const Rectification& r = rectification;
  for (const Observation& each : view.left) {
    const auto partner = rights.find(each.id);
    if (partner == rights.end()) continue;
    const auto left = rectified(rig.left, r.left_rotation, r.focal_length, r.left_center_x,
                                r.center_y, each.pixel);
    const auto right = rectified(rig.right, r.right_rotation, r.focal_length, r.right_center_x,
                                 r.center_y, partner->second);
    if (left && right) rows.push_back(std::abs(left->y() - right->y()));
  }
}

void add_distances(const Rig& rig, BoardView view, std::vector<double>& distances) {
  constexpr double kPoseScale = 1;  // [px]
  const auto pose = board_pose(rig.left, view.left);
  if (!pose) return;
  view.pose = *pose;
  Rig fixed = rig;
  std::vector<BoardView> views{view};
  BundleOptions options;
  options.free = no_parameters();
  options.free_rig = false;
  options.robust_scale = kPoseScale;
  adjust(fixed, views, options);
  const Pose& fitted = views.front().pose;
  for (const Vector2d& rest : residuals(rig.left, fitted, view.left)) {
    distances.push_back(rest.norm());
  }
  for (const Vector2d& rest : residuals(rig.right, rig.right_from_left * fitted, view.right)) {
    distances.push_back(rest.norm());
  }
}

}  // namespace

Division divide(const std::vector<BoardView>& views) {
  if (views.size() < kFewestForHoldOut) return {views, {}};
  Division result;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const bool out = i % kHoldOutStep == kHoldOutStep - 1;
    (out ? result.held_out : result.used).push_back(views[i]);
  }
  return result;
}

Fit fit_of(const Rig& rig, const Rectification& rectification, std::vector<BoardView> views) {
  Fit fit;
  for (BoardView& view : views) {
    for (Observation& each : view.left) each.weight = 1;
    for (Observation& each : view.right) each.weight = 1;
    add_rows(rig, rectification, view, fit.rows);
    add_distances(rig, view, fit.distances);
    ++fit.views;
  }
  return fit;
}

double quantile(std::vector<double> values, double part) {
  if (values.empty()) return 0;
  const auto at = static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

std::optional<Vector2d> rectified(const Camera& camera, const Matrix3& rotation,
                                  double focal_length, double center_x, double center_y,
                                  const Vector2d& pixel) {
  const auto ray = camera.ray(pixel);
  if (!ray) return std::nullopt;
  const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> turn(rotation.data());
  const Eigen::Vector3d turned = turn * *ray;
  if (turned.z() < 1e-3) return std::nullopt;
  return Vector2d(focal_length * turned.x() / turned.z() + center_x,
                  focal_length * turned.y() / turned.z() + center_y);
}

}  // namespace mtstereo::calibrate
