// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

namespace mtstereo::eval {

/// part / whole [%]; NaN if the whole is 0.
inline double percent(std::int64_t part, std::int64_t whole) {
  if (whole == 0) return std::numeric_limits<double>::quiet_NaN();
  return 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

/// A running weighted mean that ignores NaN.
class WeightedMean {
 public:
  void add(double value, double weight) {
    if (std::isnan(value)) return;
    sum_ += value * weight;
    weights_ += weight;
  }
  /// NaN if there is no value.
  double value() const {
    return weights_ > 0 ? sum_ / weights_ : std::numeric_limits<double>::quiet_NaN();
  }

 private:
  double sum_ = 0;
  double weights_ = 0;
};

}  // namespace mtstereo::eval
