// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "recordings/matching/piece.hpp"

namespace mtstereo::run {

/// When the views were taken.
struct TimeFigures {
  /// How much later the right view of a pair is, on the average; negative: earlier. By the times
  /// of the frames alone unless `measured` [s].
  double apart = 0;
  bool measured = false;   ///< in the images
  bool confirmed = false;  ///< by the matches of points in motion
  double deviation = 0;    ///< standard deviation of what was measured [s]
  std::string reason;      ///< why nothing was measured
};

/// When the views of the pairs were taken, by the times of the frames, and, with two sources, by
/// the motion in the first twenty seconds. Throws UserError.
TimeFigures check_clocks(const Work& work);

}  // namespace mtstereo::run
