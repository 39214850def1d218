// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <vector>

#include "recordings/clocks/row_matches.hpp"

namespace mtstereo::run {

/// How the clocks differ from an assumed relation, from the rows of matches: at a wrong time,
/// points of the scene are above or below their rows, by their speed times the error.
struct ClockCorrection {
  double middle = 0;           ///< the time for which `late` holds, of the left recording [s]
  double late = 0;             ///< an event in the right recording is later than assumed [s]
  double late_deviation = 0;   ///< its standard deviation [s]
  double drift = 0;            ///< what is to be added to the assumed drift
  double drift_deviation = 0;  ///< its standard deviation
  int matches = 0;             ///< those in motion that agree
  int matches_beside = 0;      ///< those that agree at best with half a frame more or less
};

/// Fits the correction and the field of row displacements to the matches of groups of successive
/// pairs. `period`: of the slower source [s]. `assumed_drift`: of the assumed relation; the
/// correction removes it if the sum is not significant or changes the offset by less than a tenth
/// of a frame from the first to the last group. std::nullopt if there are too few matches.
std::optional<ClockCorrection> fit_rows(const std::vector<std::vector<MatchedPair>>& groups,
                                        double period, double assumed_drift);

}  // namespace mtstereo::run
