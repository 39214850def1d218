// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "alignment/field_fit.hpp"
#include "mtstereo/alignment.hpp"

namespace mtstereo {

/// Decides whether a fit can be trusted and which of its terms are needed.

/// What a trusted fit has at least, or at most.
inline constexpr int kFewestInliers = 40;
inline constexpr double kLeastInlierShare = 0.65;
inline constexpr double kLargestResidual = 0.45;   ///< [px]
inline constexpr double kLargestDeviation = 0.15;  ///< [px]
inline constexpr int kFewestCells = 5;

/// What a trusted fit has at most: corners that are found at several places, per match.
inline constexpr double kLargestRepeatedShare = 0.25;

/// How much larger the capped chi-square of a smaller model may be, in all and for each term that
/// it lacks.
inline constexpr double kChiSquareBase = 20;
inline constexpr double kChiSquareTerm = 6;

/// A model may lack terms that the matches do not determine while its capped chi-square is at most
/// this many times as large as with all terms.
inline constexpr double kChiSquareFactor = 1.5;

/// Fields with a smaller rms are not corrected [px].
inline constexpr double kFieldFloor = 0.1;

/// The decision on a fit.
struct FieldChoice {
  FieldStatus status = FieldStatus::kTooFewMatches;
  FieldModel model;  ///< with trust only, otherwise without terms
};

/// Chooses the smallest model that explains the matches about as well as the largest one whose
/// predicted error is small enough. Fields below `floor` become zero. `repeated` counts the corners
/// that were found at several places, which are no matches.
FieldChoice choose_field(const FieldFit& fit, int matches, int repeated, double floor, int width,
                         int height);

}  // namespace mtstereo
