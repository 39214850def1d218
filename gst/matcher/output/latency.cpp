// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/output/latency.hpp"

#include <algorithm>
#include <cmath>

namespace mtstereo::plugin {
namespace {

constexpr double kWeightOfNewest = 0.125;
constexpr double kWeightOfNewestDeviation = 0.25;
constexpr double kHeadroom = 1.05;
constexpr double kExcess = 1.35;  // of the reported over the fitting value

}  // namespace

bool ProcessingLatency::measured(double milliseconds) {
  if (first_) {
    first_ = false;
    return false;
  }
  if (average_ == 0) {
    average_ = milliseconds;
  } else {
    // One pair that took very long, for example while the computer was busy, has a limited effect.
    const double error = std::min(milliseconds - average_, average_);
    deviation_ += kWeightOfNewestDeviation * (std::abs(error) - deviation_);
    average_ += kWeightOfNewest * error;
  }
  const double fitting = expected_ms() * kHeadroom;
  if (expected_ms() <= reported_ && reported_ <= fitting * kExcess) return false;
  reported_ = fitting;
  return true;
}

}  // namespace mtstereo::plugin
