// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "recordings/clocks/motion_signature.hpp"

namespace mtstereo::run {

/// A lag at which two signatures agree.
struct Lag {
  double seconds = 0;  ///< a change at the time t of the left one is at t + seconds in the right
  double correlation = 0;  ///< of the part that both have [-1 .. 1]
  double score = 0;        ///< the correlation, less if that part is short
  double overlap = 0;      ///< length of that part [s]
};

/// The lags with the highest correlation among all at which the recordings overlap by at least two
/// seconds, the best first, at most `count` of them. Lags next to a better one are left out.
/// `period`: of the slower source [s]. `drift`: how much the clocks may differ (relative).
std::vector<Lag> search_lags(const MotionSignature& left, const MotionSignature& right,
                             double period, double drift, int count);

}  // namespace mtstereo::run
