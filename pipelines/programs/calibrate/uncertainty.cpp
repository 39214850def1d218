// SPDX-License-Identifier: LGPL-2.1-or-later
#include "programs/calibrate/uncertainty.hpp"

#include <Eigen/LU>
#include <cmath>
#include <functional>

namespace mtstereo::calibrate {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

// The standard deviation of a function of the rig. The steps are a part of each parameter's own
// standard deviation.
double deviation(const Solution& solution, const std::function<double(const Rig&)>& function) {
  const Eigen::MatrixXd& covariance = solution.result.covariance;
  VectorXd slope(covariance.rows());
  for (Eigen::Index i = 0; i < slope.size(); ++i) {
    const double step = std::max(1e-9, 0.01 * std::sqrt(covariance(i, i)));
    VectorXd shift = VectorXd::Zero(slope.size());
    shift(i) = step;
    slope(i) = (function(moved(solution.rig, solution.options, shift)) -
                function(moved(solution.rig, solution.options, -shift))) /
               (2 * step);
  }
  return std::sqrt(std::max(0.0, slope.dot(covariance * slope)));
}

// The depth at which the rays of two pixels are nearest to each other [m].
double triangulate(const Rig& rig, const Vector2d& left, const Vector2d& right) {
  const auto a = rig.left.ray(left);
  const auto b = rig.right.ray(right);
  if (!a || !b) return std::nan("");
  const Pose back = rig.right_from_left.inverse();
  Eigen::Matrix<double, 3, 2> rays;
  rays.col(0) = *a;
  rays.col(1) = -(back.rotation * *b);
  // Its normal equations: Eigen's decompositions would take longer to compile than all else here.
  const Eigen::Matrix2d normal = rays.transpose() * rays;
  const Vector2d along = normal.inverse() * (rays.transpose() * back.translation);
  return along.x() * a->z();
}

}  // namespace

std::optional<Uncertainty> uncertainty_of(const Solution& solution) {
  if (solution.result.covariance.size() == 0) return std::nullopt;
  return Uncertainty{
      deviation(solution, [](const Rig& rig) { return rig.left.focal(); }),
      deviation(solution, [](const Rig& rig) { return rig.right.focal(); }),
      deviation(solution, [](const Rig& rig) { return rig.baseline(); }),
  };
}

std::optional<double> depth_uncertainty(const Solution& solution, double depth) {
  if (solution.result.covariance.size() == 0) return std::nullopt;
  const Rig& rig = solution.rig;
  const Vector3d middle = rig.right_from_left.inverse().translation / 2;
  const Vector3d point(middle.x(), middle.y(), depth);
  const auto left = rig.left.project(point);
  const auto right = rig.right.project(rig.right_from_left * point);
  if (!left || !right) return std::nullopt;
  const double result =
      deviation(solution, [&](const Rig& each) { return triangulate(each, *left, *right); });
  if (!std::isfinite(result)) return std::nullopt;
  return result;
}

}  // namespace mtstereo::calibrate
