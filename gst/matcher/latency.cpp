// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/latency.hpp"

#include <cmath>

namespace mtstereo::plugin {
namespace {

constexpr double kWeightOfNewest = 0.125;
constexpr double kHeadroom = 1.05;
constexpr double kDeviation = 0.25;

}  // namespace

bool ProcessingLatency::measured(double milliseconds) {
  if (first_) {
    first_ = false;
    return false;
  }
  average_ = average_ == 0 ? milliseconds : average_ + kWeightOfNewest * (milliseconds - average_);
  const double fitting = average_ * kHeadroom;
  if (std::abs(fitting - reported_) <= kDeviation * reported_) return false;
  reported_ = fitting;
  return true;
}

}  // namespace mtstereo::plugin
