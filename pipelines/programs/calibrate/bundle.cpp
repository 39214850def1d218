// SPDX-License-Identifier: LGPL-2.1-or-later
#include "programs/calibrate/bundle.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace mtstereo::calibrate {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Matrix23 = Eigen::Matrix<double, 2, 3>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr double kFarAway = 1e4;  // the residual of a point without an image [px]
constexpr double kFirstDamping = 1e-3;
constexpr double kMostDamping = 1e12;
constexpr double kSmallDecrease = 1e-12;  // relative to the cost

enum class Side { kLeft, kRight };

std::vector<int> free_parameters(const Camera& camera, const BundleOptions& options) {
  std::vector<int> result;
  for (int i = 0; i < parameter_count(camera.model); ++i) {
    if (options.free[static_cast<std::size_t>(i)]) result.push_back(i);
  }
  return result;
}

// Residuals as one column: x0 y0 x1 y1 ...
VectorXd stacked(const Camera& camera, const Pose& pose, const std::vector<Observation>& seen) {
  VectorXd result(2 * static_cast<Eigen::Index>(seen.size()));
  Eigen::Index row = 0;
  for (const Observation& each : seen) {
    const auto image = camera.project(pose * each.point);
    result.segment<2>(row) =
        image ? Eigen::Vector2d(each.pixel - *image) : Eigen::Vector2d(kFarAway, kFarAway);
    row += 2;
  }
  return result;
}

// The derivative of an image by Pose::moved() of the pose that turned its point; without that, it
// is the one by the point.
Eigen::Matrix<double, 2, 6> by_motion(const Matrix23& by_point, const Vector3d& turned) {
  Matrix3d cross;
  cross << 0, turned.z(), -turned.y(), -turned.z(), 0, turned.x(), turned.y(), -turned.x(), 0;
  Eigen::Matrix<double, 2, 6> result;
  result << by_point * cross, by_point;
  return result;
}

// The part of the cost of squared residual `square`, and its derivative.
struct Loss {
  double cost;
  double weight;
};

Loss loss_of(double square, double scale) {
  if (scale <= 0) return {square, 1};
  const double ratio = square / (scale * scale);
  return {scale * scale * std::log1p(ratio), 1 / (1 + ratio)};
}

// The normal equations: of the parameters of all views (u, g), of the pose of each view (v, h),
// and what connects them (w).
struct Equations {
  double cost = 0;
  MatrixXd u;
  VectorXd g;
  std::vector<MatrixXd> w;
  std::vector<Matrix6> v;
  std::vector<Vector6> h;
};

class Adjustment {
 public:
  Adjustment(const Rig& rig, const BundleOptions& options)
      : options_(options),
        left_(free_parameters(rig.left, options)),
        right_(free_parameters(rig.right, options)),
        count_(std::max(free_count(rig, options), 1)) {}

  double cost(const Rig& rig, const std::vector<BoardView>& views) const {
    if (rig.left.focal() <= 0 || rig.right.focal() <= 0) {
      return std::numeric_limits<double>::infinity();
    }
    double sum = 0;
    for (const BoardView& view : views) {
      sum += cost(rig.left, view.pose, view.left);
      sum += cost(rig.right, rig.right_from_left * view.pose, view.right);
    }
    return sum;
  }

  Equations linearize(const Rig& rig, const std::vector<BoardView>& views) const {
    Equations result;
    result.u.setZero(count_, count_);
    result.g.setZero(count_);
    for (const BoardView& view : views) {
      result.w.emplace_back(MatrixXd::Zero(count_, 6));
      result.v.emplace_back(Matrix6::Zero());
      result.h.emplace_back(Vector6::Zero());
      add(rig, view, Side::kLeft, result);
      add(rig, view, Side::kRight, result);
    }
    return result;
  }

 private:
  double cost(const Camera& camera, const Pose& pose, const std::vector<Observation>& seen) const {
    const VectorXd rest = stacked(camera, pose, seen);
    double sum = 0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const double square = rest.segment<2>(2 * static_cast<Eigen::Index>(i)).squaredNorm();
      sum += seen[i].weight * loss_of(square, options_.robust_scale).cost;
    }
    return sum;
  }

  void add(const Rig& rig, const BoardView& view, Side side, Equations& equations) const {
    const bool left = side == Side::kLeft;
    const Camera& camera = left ? rig.left : rig.right;
    const auto& seen = left ? view.left : view.right;
    if (seen.empty()) return;
    const auto rows = 2 * static_cast<Eigen::Index>(seen.size());
    VectorXd rest = VectorXd::Constant(rows, kFarAway);
    MatrixXd global = MatrixXd::Zero(rows, count_);
    MatrixXd local = MatrixXd::Zero(rows, 6);
    const auto rig_column = static_cast<Eigen::Index>(left_.size() + right_.size());
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const auto row = 2 * static_cast<Eigen::Index>(i);
      const Vector3d turned = view.pose.rotation * seen[i].point;
      const Vector3d in_left = turned + view.pose.translation;
      const auto image = camera.linearize(left ? in_left : rig.right_from_left * in_left);
      if (!image) continue;
      rest.segment<2>(row) = seen[i].pixel - image->pixel;
      Eigen::Index column = left ? 0 : static_cast<Eigen::Index>(left_.size());
      for (const int index : left ? left_ : right_) {
        global.block<2, 1>(row, column++) = image->by_values.col(index);
      }
      const Matrix3d& to_right = rig.right_from_left.rotation;
      const Matrix23 by_left = left ? image->by_point : Matrix23(image->by_point * to_right);
      local.middleRows<2>(row) = by_motion(by_left, turned);
      if (left || !options_.free_rig) continue;
      global.block<2, 6>(row, rig_column) = by_motion(image->by_point, to_right * in_left);
    }
    accumulate(rest, seen, global, local, equations);
  }

  void accumulate(VectorXd rest, const std::vector<Observation>& seen, MatrixXd& global,
                  MatrixXd& local, Equations& equations) const {
    VectorXd roots(rest.size());
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const auto row = 2 * static_cast<Eigen::Index>(i);
      const Loss loss = loss_of(rest.segment<2>(row).squaredNorm(), options_.robust_scale);
      equations.cost += seen[i].weight * loss.cost;
      // A point without an image has no derivative.
      const double finite = rest(row) < kFarAway ? 1 : 0;
      roots.segment<2>(row).setConstant(std::sqrt(seen[i].weight * loss.weight) * finite);
    }
    global.array().colwise() *= roots.array();
    local.array().colwise() *= roots.array();
    rest.array() *= roots.array();
    equations.u.noalias() += global.transpose() * global;
    equations.g.noalias() += global.transpose() * rest;
    equations.w.back().noalias() += global.transpose() * local;
    equations.v.back().noalias() += local.transpose() * local;
    equations.h.back().noalias() += local.transpose() * rest;
  }

  BundleOptions options_;
  std::vector<int> left_, right_;
  // At least 1: Eigen does not allow for matrices without columns everywhere. No observation
  // depends on a parameter that only fills it up, so it stays where it is.
  Eigen::Index count_;
};

// Parameters that no observation depends on stay where they are.
template <typename Matrix>
void damp(Matrix& matrix, double damping) {
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    matrix(i, i) = matrix(i, i) > 0 ? matrix(i, i) * (1 + damping) : 1;
  }
}

struct Step {
  VectorXd global;
  std::vector<Vector6> local;
};

Step solve(const Equations& equations, double damping) {
  MatrixXd u = equations.u;
  damp(u, damping);
  VectorXd g = equations.g;
  std::vector<Eigen::LDLT<Matrix6>> inverse;
  for (std::size_t i = 0; i < equations.v.size(); ++i) {
    Matrix6 v = equations.v[i];
    damp(v, damping);
    inverse.emplace_back(v);
    u -= equations.w[i] * inverse.back().solve(equations.w[i].transpose());
    g -= equations.w[i] * inverse.back().solve(equations.h[i]);
  }
  Step step;
  step.global = u.ldlt().solve(g);
  for (std::size_t i = 0; i < inverse.size(); ++i) {
    step.local.emplace_back(
        inverse[i].solve(equations.h[i] - equations.w[i].transpose() * step.global));
  }
  return step;
}

// The inverse of the Schur complement, in units that make its diagonal 1; empty if it has none.
MatrixXd covariance_of(const Equations& equations, double variance) {
  MatrixXd schur = equations.u;
  for (std::size_t i = 0; i < equations.v.size(); ++i) {
    Matrix6 v = equations.v[i];
    damp(v, 0);
    schur -= equations.w[i] * v.ldlt().solve(equations.w[i].transpose());
  }
  const VectorXd diagonal = schur.diagonal();
  if (!(diagonal.minCoeff() > 0)) return {};
  const VectorXd scale = diagonal.cwiseSqrt().cwiseInverse();
  const MatrixXd scaled = scale.asDiagonal() * schur * scale.asDiagonal();
  const Eigen::LLT<MatrixXd> factors(scaled);
  if (factors.info() != Eigen::Success) return {};
  const MatrixXd inverse = factors.solve(MatrixXd::Identity(schur.rows(), schur.rows()));
  return variance * (scale.asDiagonal() * inverse * scale.asDiagonal());
}

void summarize(const Rig& rig, const std::vector<BoardView>& views, BundleResult& result) {
  double sum = 0;
  const auto add = [&](const Camera& camera, const Pose& pose, const auto& seen) {
    const auto rest = residuals(camera, pose, seen);
    for (std::size_t i = 0; i < seen.size(); ++i) {
      if (seen[i].weight <= 0) continue;
      ++result.observations;
      sum += rest[i].squaredNorm();
    }
  };
  for (const BoardView& view : views) {
    add(rig.left, view.pose, view.left);
    add(rig.right, rig.right_from_left * view.pose, view.right);
  }
  result.rms = result.observations > 0 ? std::sqrt(sum / result.observations) : 0;
}

}  // namespace

std::array<bool, kMostParameters> all_parameters() {
  std::array<bool, kMostParameters> result{};
  result.fill(true);
  return result;
}

std::array<bool, kMostParameters> no_parameters() { return {}; }

std::vector<Eigen::Vector2d> residuals(const Camera& camera, const Pose& pose,
                                       const std::vector<Observation>& seen) {
  const VectorXd rest = stacked(camera, pose, seen);
  std::vector<Eigen::Vector2d> result;
  for (Eigen::Index row = 0; row < rest.size(); row += 2) {
    result.emplace_back(rest.segment<2>(row));
  }
  return result;
}

int free_count(const Rig& rig, const BundleOptions& options) {
  return static_cast<int>(free_parameters(rig.left, options).size() +
                          free_parameters(rig.right, options).size()) +
         (options.free_rig ? 6 : 0);
}

Rig moved(const Rig& rig, const BundleOptions& options, const VectorXd& step) {
  Rig result = rig;
  Eigen::Index at = 0;
  for (Camera* camera : {&result.left, &result.right}) {
    for (const int index : free_parameters(*camera, options)) {
      camera->values[static_cast<std::size_t>(index)] += step(at++);
    }
  }
  if (options.free_rig) result.right_from_left = rig.right_from_left.moved(step.segment<6>(at));
  return result;
}

BundleResult adjust(Rig& rig, std::vector<BoardView>& views, const BundleOptions& options) {
  const Adjustment adjustment(rig, options);
  Equations equations = adjustment.linearize(rig, views);
  BundleResult result;
  double damping = kFirstDamping;
  for (int i = 0; i < options.iterations && !result.converged; ++i) {
    const Step step = solve(equations, damping);
    const Rig trial_rig = moved(rig, options, step.global);
    std::vector<BoardView> trial = views;
    for (std::size_t k = 0; k < views.size(); ++k) {
      trial[k].pose = views[k].pose.moved(step.local[k]);
    }
    const double cost = adjustment.cost(trial_rig, trial);
    if (cost < equations.cost) {
      result.converged = equations.cost - cost <= kSmallDecrease * equations.cost;
      rig = trial_rig;
      views = std::move(trial);
      equations = adjustment.linearize(rig, views);
      damping = std::max(damping / 10, 1e-12);
    } else {
      damping *= 10;
      result.converged = damping > kMostDamping || equations.cost == 0;
    }
  }
  summarize(rig, views, result);
  const auto unknowns =
      static_cast<double>(free_count(rig, options)) + 6 * static_cast<double>(views.size());
  const double spare = 2.0 * result.observations - unknowns;
  if (options.robust_scale == 0 && spare > 0) {
    result.covariance = covariance_of(equations, equations.cost / spare);
  }
  return result;
}

}  // namespace mtstereo::calibrate
