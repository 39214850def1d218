// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "recordings/checks/clock_check.hpp"
#include "recordings/matching/range_search.hpp"
#include "recordings/matching/view_checks.hpp"
#include "recordings/matching/view_inspection.hpp"

// What mtstereo-run --check measures: at most twelve pairs from the whole recording, and for the
// clocks of two sources their first twenty seconds.

namespace mtstereo::run {

/// The gray values of one view.
struct ViewFigures {
  double mean = 0;       ///< [gray values]
  double bright = 0;     ///< that 95 % of the pixels do not exceed [gray values]
  double saturated = 0;  ///< share of the pixels [0 .. 1]
  double noise = 0;      ///< standard deviation [gray values]
};

/// What a mode gives.
struct ModeFigures {
  std::string name;             ///< "dense", or "semi-dense, half-refined"
  double density = 0;           ///< pixels with a disparity [0 .. 1]
  std::optional<double> wrong;  ///< share of wrong disparities by the odds of their confidence
  double milliseconds = 0;      ///< median of the pairs
  double fine_detail = 0;       ///< median; 0: not measured
};

/// All that was measured.
struct CheckFigures {
  Work work;                 ///< with the range and the correction that the figures belong to
  bool range_given = false;  ///< by the options or the data set; otherwise it was found
  std::optional<FoundRange> range;  ///< that suffices; none: the views do not match
  bool corrected = true;            ///< rows and sharpness are, by the options
  ViewInspection inspection;
  ViewDiagnosis diagnosis;
  std::array<ViewFigures, 2> views;  ///< left, right
  TimeFigures times;
  std::vector<ModeFigures> modes;  ///< empty if the results are useless

  /// The figures of a mode, or none.
  const ModeFigures* mode(const std::string& name) const;
};

/// The names of modes that the findings use.
inline constexpr const char* kSemiDense = "semi-dense";
inline constexpr const char* kHalfRefined = "semi-dense, half-refined";

/// Measures a recording. `relation` and `estimate`: of its clocks, as for prepare(). Throws
/// UserError.
CheckFigures measure(const Recording& recording, const WorkOptions& options,
                     const std::optional<ClockRelation>& relation, bool estimate);

}  // namespace mtstereo::run
