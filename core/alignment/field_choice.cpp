// SPDX-License-Identifier: LGPL-2.1-or-later
#include "alignment/field_choice.hpp"

#include <algorithm>

namespace mtstereo {
namespace {

/// Whether the matches are good enough for any field.
FieldStatus status_of(const FieldFit& fit, int matches, int repeated) {
  if (repeated > kLargestRepeatedShare * std::max(matches, kFewestInliers)) {
    return FieldStatus::kRepeatedPattern;
  }
  if (matches < kFewestInliers) return FieldStatus::kTooFewMatches;
  if (fit.inliers < kFewestInliers || fit.inliers < kLeastInlierShare * matches) {
    return FieldStatus::kTooFewInliers;
  }
  if (fit.negative_share > 0.5) return FieldStatus::kSwapped;
  if (fit.residual > kLargestResidual) return FieldStatus::kTooScattered;
  if (fit.occupied_cells < kFewestCells) return FieldStatus::kTooConcentrated;
  return FieldStatus::kTrusted;
}

/// By how much the capped chi-square of a model without this many terms may be larger.
double allowed_excess(int missing) {
  return missing > 0 ? kChiSquareBase + kChiSquareTerm * missing : 0;
}

}  // namespace

FieldChoice choose_field(const FieldFit& fit, int matches, int repeated, double floor, int width,
                         int height) {
  FieldChoice choice;
  choice.status = status_of(fit, matches, repeated);
  if (choice.status != FieldStatus::kTrusted) return choice;
  std::size_t largest = fit.models.size() - 1;
  while (largest > 0 && fit.models[largest].deviation > kLargestDeviation) --largest;
  const double explained = fit.full().chi_square;
  if (largest == 0 ||
      fit.models[largest].chi_square > kChiSquareFactor * explained + allowed_excess(kFieldTerms)) {
    choice.status = FieldStatus::kTooUncertain;
    return choice;
  }
  for (const FieldModel& model : fit.models) {
    const int missing = fit.models[largest].terms - model.terms;
    if (model.chi_square > fit.models[largest].chi_square + allowed_excess(missing)) continue;
    choice.model = model;
    break;
  }
  if (choice.model.field.rms(width, height) < floor) {
    choice.model.terms = 0;
    choice.model.field = {};
  }
  return choice;
}

}  // namespace mtstereo
