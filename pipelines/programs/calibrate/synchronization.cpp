// SPDX-License-Identifier: LGPL-2.1-or-later
#include "programs/calibrate/synchronization.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "programs/calibrate/start_values.hpp"

namespace mtstereo::calibrate {
namespace {

using Eigen::Index;
using Eigen::Vector2d;
using Eigen::VectorXd;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr double kLongestStep = 0.2;  // [s] between pairs of one motion
constexpr double kSlowest = 0.03;     // of the image's width per second
constexpr double kLargestMisfit = 4;  // of a pair: beyond, its corners are wrong [px]
constexpr int kFewestPairs = 8;
constexpr double kSmallestOffset = 0.002;  // that matters [s]
constexpr double kSignificance = 4;        // standard deviations
constexpr std::size_t kMostPairs = 200;    // that are measured
constexpr int kSteps = 6;

// A view in motion.
struct MovingView {
  BoardView view;                // its right view has only the corners with a known speed
  std::vector<Vector2d> speeds;  // of the corners of the right view [px/s]
};

// The middle one of three moments.
MovingView moving_view(const Moment& before, const Moment& now, const Moment& after) {
  std::map<int, Vector2d> first, last;
  for (const Observation& each : before.view.right) first.emplace(each.id, each.pixel);
  for (const Observation& each : after.view.right) last.emplace(each.id, each.pixel);
  MovingView result{now.view, {}};
  result.view.right.clear();
  for (const Observation& each : now.view.right) {
    const auto a = first.find(each.id);
    const auto b = last.find(each.id);
    if (a == first.end() || b == last.end()) continue;
    result.view.right.push_back(each);
    result.speeds.emplace_back((b->second - a->second) / (after.time - before.time));
  }
  return result;
}

double mean_speed(const std::vector<Vector2d>& speeds) {
  double sum = 0;
  for (const Vector2d& each : speeds) sum += each.norm();
  return speeds.empty() ? 0 : sum / static_cast<double>(speeds.size());
}

// Residuals of both views for a pose of the board, if the right view is `offset` later.
VectorXd residuals_at(const Rig& rig, const MovingView& moving, const Pose& pose, double offset) {
  const BoardView& view = moving.view;
  const auto left = residuals(rig.left, pose, view.left);
  const auto right = residuals(rig.right, rig.right_from_left * pose, view.right);
  VectorXd result(2 * static_cast<Index>(left.size() + right.size()));
  Index row = 0;
  for (const Vector2d& each : left) {
    result.segment<2>(row) = each;
    row += 2;
  }
  for (std::size_t i = 0; i < right.size(); ++i) {
    result.segment<2>(row) = right[i] - offset * moving.speeds[i];
    row += 2;
  }
  return result;
}

struct Estimate {
  double offset;
  double weight;
};

// The offset of one pair: pose and offset are adjusted together.
std::optional<Estimate> estimate(const Rig& rig, const MovingView& moving) {
  const auto start = board_pose(rig.left, moving.view.left);
  if (!start) return std::nullopt;
  Pose pose = *start;
  double offset = 0;
  Eigen::LDLT<Eigen::MatrixXd> information;
  VectorXd rest;
  for (int i = 0; i < kSteps; ++i) {
    rest = residuals_at(rig, moving, pose, offset);
    Eigen::MatrixXd slope(rest.size(), 7);
    for (int k = 0; k < 6; ++k) {
      constexpr double kStep = 1e-6;
      const Vector6 step = Vector6::Unit(k) * kStep;
      slope.col(k) = (residuals_at(rig, moving, pose.moved(-step), offset) -
                      residuals_at(rig, moving, pose.moved(step), offset)) /
                     (2 * kStep);
    }
    slope.col(6) = rest - residuals_at(rig, moving, pose, offset + 1);
    information.compute(slope.transpose() * slope);
    const VectorXd step = information.solve(slope.transpose() * rest);
    if (!step.allFinite()) return std::nullopt;
    pose = pose.moved(step.head<6>());
    offset += step(6);
  }
  const double misfit = std::sqrt(2 * rest.squaredNorm() / static_cast<double>(rest.size()));
  const VectorXd last = information.solve(VectorXd::Unit(7, 6));
  const double variance = last(6);
  if (!(misfit < kLargestMisfit) || !(variance > 0)) return std::nullopt;
  return Estimate{offset, 1 / variance};
}

// The value that half of the weight is below.
double weighted_median(std::vector<Estimate> values) {
  std::sort(values.begin(), values.end(),
            [](const Estimate& a, const Estimate& b) { return a.offset < b.offset; });
  double sum = 0;
  for (const Estimate& each : values) sum += each.weight;
  double below = 0;
  for (const Estimate& each : values) {
    below += each.weight;
    if (below >= sum / 2) return each.offset;
  }
  return 0;
}

}  // namespace

void Track::add(double time, BoardView view) {
  moments_.push_back({time, std::move(view)});
  if (moments_.size() > kMost) moments_.pop_front();
}

bool TimeOffset::significant() const {
  return pairs >= kFewestPairs &&
         std::abs(seconds) > std::max(kSmallestOffset, kSignificance * deviation);
}

std::optional<TimeOffset> estimate_offset(const Rig& rig, const Track& track, bool swapped) {
  std::deque<Moment> moments = track.moments();
  if (swapped) {
    for (Moment& moment : moments) std::swap(moment.view.left, moment.view.right);
  }
  std::vector<MovingView> moving;
  for (std::size_t i = 1; i + 1 < moments.size(); ++i) {
    const double first = moments[i].time - moments[i - 1].time;
    const double second = moments[i + 1].time - moments[i].time;
    if (!(first > 0 && second > 0 && first <= kLongestStep && second <= kLongestStep)) continue;
    MovingView view = moving_view(moments[i - 1], moments[i], moments[i + 1]);
    if (view.speeds.size() < kFewestCorners) continue;
    if (mean_speed(view.speeds) >= kSlowest * rig.right.width) moving.push_back(std::move(view));
  }
  std::vector<Estimate> estimates;
  const std::size_t step = 1 + moving.size() / kMostPairs;
  for (std::size_t i = 0; i < moving.size(); i += step) {
    const auto found = estimate(rig, moving[i]);
    if (found) estimates.push_back(*found);
  }
  if (static_cast<int>(estimates.size()) < kFewestPairs) return std::nullopt;
  TimeOffset result;
  result.pairs = static_cast<int>(estimates.size());
  result.seconds = weighted_median(estimates);
  std::vector<Estimate> distances = estimates;
  for (Estimate& each : distances) each.offset = std::abs(each.offset - result.seconds);
  result.deviation = 1.4826 * weighted_median(distances) / std::sqrt(result.pairs);
  return result;
}

}  // namespace mtstereo::calibrate
