// SPDX-License-Identifier: LGPL-2.1-or-later
#include "programs/calibrate/view_choice.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "lib/median.hpp"

namespace mtstereo::calibrate {
namespace {

constexpr double kDifference = 0.2;         // of placements, in video
constexpr double kRepetition = 0.02;        // of placements, in images
constexpr double kStillSpeed = 0.04;        // of the diagonal of the image, per second
constexpr double kStillDistance = 0.01;     // of the diagonal, between two images
constexpr double kShortestStep = 1.0 / 60;  // [s]; corners jitter even if nothing moves

double diagonal(cv::Size size) { return std::hypot(size.width, size.height); }

}  // namespace

std::optional<double> movement(const Corners& before, const Corners& after) {
  std::map<int, cv::Point2f> old;
  for (std::size_t i = 0; i < before.ids.size(); ++i) {
    old.emplace(before.ids[i], before.pixels[i]);
  }
  std::vector<double> distances;
  for (std::size_t i = 0; i < after.ids.size(); ++i) {
    const auto found = old.find(after.ids[i]);
    if (found != old.end()) distances.push_back(cv::norm(after.pixels[i] - found->second));
  }
  if (distances.empty()) return std::nullopt;
  return median(std::move(distances));
}

ViewChoice::ViewChoice(const BoardOptions& board, cv::Size left, cv::Size right, Choice choice)
    : board_(board), left_(left), right_(right), choice_(choice), coverage_(board, left, right) {}

bool ViewChoice::still(const CornerPair& pair, double time) const {
  constexpr double kLongestGap = 1;  // [s]; earlier movement does not count
  if (!last_) return false;
  const double step = time - last_->time;
  if (step < 0 || step > kLongestGap) return false;
  const auto slow = [&](const Corners& before, const Corners& after, cv::Size size) {
    const auto distance = movement(before, after);
    return distance && *distance <= kStillDistance * diagonal(size) &&
           *distance <= kStillSpeed * diagonal(size) * std::max(step, kShortestStep);
  };
  return slow(last_->pair.left, pair.left, left_) && slow(last_->pair.right, pair.right, right_);
}

Verdict ViewChoice::offer(const CornerPair& pair, double time) {
  if (!pair.usable()) {
    last_.reset();
    return Verdict::kNoBoard;
  }
  const bool rests = choice_ == Choice::kStills || still(pair, time);
  last_ = Seen{pair, time};
  if (!rests) return Verdict::kMoving;
  const Placement here = placement_of(pair.left, board_, left_);
  const double least = choice_ == Choice::kStills ? kRepetition : kDifference;
  for (const Placement& taken : coverage_.placements()) {
    if (here.distance(taken) <= least) return Verdict::kSimilar;
  }
  coverage_.add(pair);
  return Verdict::kTaken;
}

}  // namespace mtstereo::calibrate
