// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/pairing/stream_offset.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace mtstereo::plugin {
namespace {

constexpr double kForgetting = 1.0 - 1.0 / 256;
constexpr double kWeightOfNewest = 0.02;
// A new pair changes the value by 1 / (pairs + kCaution) at first, so that jitter of the first
// pairs does not become an offset.
constexpr int kCaution = 4;

/// The representative of `difference` modulo `period` that is nearest to `center`.
double nearest(double difference, double center, double period) {
  return difference - period * std::round((difference - center) / period);
}

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// For each left frame the difference to the nearest right one, modulo `period`.
std::vector<double> differences(std::span<const Nanoseconds> left,
                                std::span<const Nanoseconds> right, double period) {
  std::vector<double> result;
  for (const Nanoseconds time : left) {
    const auto distance = [time](Nanoseconds other) { return std::llabs(other - time); };
    const Nanoseconds partner =
        *std::min_element(right.begin(), right.end(),
                          [&](Nanoseconds a, Nanoseconds b) { return distance(a) < distance(b); });
    // A frame at the end of one queue may be far from all frames of the other.
    const double difference = static_cast<double>(partner - time);
    if (std::abs(difference) > 3 * period) continue;
    const double center = result.empty() ? 0 : result.front();
    result.push_back(nearest(difference, center, period));
  }
  return result;
}

}  // namespace

void DifferenceLine::add(Nanoseconds time, Nanoseconds difference) {
  if (pairs_ == 0) origin_ = time;
  ++pairs_;
  last_time_ = static_cast<double>(time - origin_) * 1e-9;
  weight_ = kForgetting * weight_ + 1;
  const double share = 1 / weight_;
  const double from_time = last_time_ - time_;
  const double from_difference = static_cast<double>(difference) - difference_;
  time_ += share * from_time;
  difference_ += share * from_difference;
  const double keep = 1 - share;
  time_square_ = keep * (time_square_ + share * from_time * from_time);
  product_ = keep * (product_ + share * from_time * from_difference);
  difference_square_ = keep * (difference_square_ + share * from_difference * from_difference);
}

DifferenceStatistics DifferenceLine::statistics() const {
  const bool sloped = pairs_ >= kPairsOfDrift && time_square_ > 0;
  const double slope = sloped ? product_ / time_square_ : 0;
  const double variance = difference_square_ - slope * (sloped ? product_ : 0);
  return {pairs_, difference_ + slope * (last_time_ - time_), std::sqrt(std::max(variance, 0.0)),
          slope};
}

bool StreamOffset::learn(std::span<const Nanoseconds> left, std::span<const Nanoseconds> right,
                         Nanoseconds period, int frames) {
  const auto needed = static_cast<std::size_t>(std::max(frames, 1));
  if (left.size() < needed || right.size() < needed || period <= 0) return false;
  const auto length = static_cast<double>(period);
  std::vector<double> found = differences(left, right, length);
  if (found.empty()) return false;
  const double middle = median(found);
  for (double& difference : found) difference = std::abs(difference - middle);
  const double spread = median(found);
  // The median of a few jittery differences is not an offset.
  const double offset = nearest(middle, 0, length);
  value_ = std::abs(offset) > 4 * spread ? offset : 0;
  known_ = true;
  pairs_ = 0;
  if (std::abs(line_.statistics().mean - value_) * 4 > length) line_ = {};
  return true;
}

void StreamOffset::add(Nanoseconds left_time, Nanoseconds difference) {
  known_ = true;
  ++pairs_;
  const double share = std::max(kWeightOfNewest, 1.0 / (pairs_ + kCaution));
  value_ += share * (static_cast<double>(difference) - value_);
  line_.add(left_time, difference);
  // A mean follows a drift with a delay, a line does not.
  const DifferenceStatistics statistics = line_.statistics();
  if (statistics.pairs >= DifferenceLine::kPairsOfDrift) value_ = statistics.mean;
}

void StreamOffset::slip(Nanoseconds distance) {
  value_ += static_cast<double>(distance);
  line_ = {};
}

}  // namespace mtstereo::plugin
