// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "programs/calibrate/calibrating.hpp"
#include "programs/calibrate/coverage.hpp"
#include "programs/calibrate/synchronization.hpp"
#include "programs/calibrate/uncertainty.hpp"

namespace mtstereo::calibrate {

/// What makes a calibration less good than it could be, and what to do.
struct Warning {
  std::string name;  ///< such as "few-views"
  std::string text;
};

/// The expected error of depths.
struct DepthError {
  double depth = 0;                   ///< [m]
  double matching = 0;                ///< from kDisparityError, standard deviation [m]
  std::optional<double> calibration;  ///< from the calibration, if it is known [m]
  /// Both together [m].
  double total() const;
};

/// The error of a disparity that DepthError assumes [px]: what a matcher with sub-pixel
/// disparities reaches on textured surfaces.
inline constexpr double kDisparityError = 0.3;

/// How good a calibration is as a whole.
enum class Grade {
  kGood,    ///< use it
  kUsable,  ///< a better one is worth the time
  kPoor,    ///< do not use it
};

/// "good", "usable" or "poor".
const char* grade_name(Grade grade);

/// The figures of a calibration for its user.
struct Quality {
  Grade grade = Grade::kPoor;
  std::optional<Uncertainty> uncertainty;
  std::vector<DepthError> depths;  ///< at 1, 2, 5 and 10 m
  std::optional<TimeOffset> offset;
  std::vector<Warning> warnings;
};

/// Judges a calibration by its figures and the coverage of its views.
Quality judge(const Calibrated& calibrated, const Coverage& coverage,
              const std::optional<TimeOffset>& offset);

}  // namespace mtstereo::calibrate
