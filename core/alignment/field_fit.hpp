// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <span>
#include <vector>

#include "alignment/match.hpp"
#include "alignment/row_field.hpp"

namespace mtstereo {

/// Fits a RowField to matches, of which many may be wrong.

/// Matches farther away from the field than this are outliers [px].
inline constexpr double kInlierLimit = 1;

/// Residuals of more than this many standard deviations count as that many, so that single matches
/// cannot decide which terms are needed.
inline constexpr double kResidualCap = 3;

/// The numbers of terms that a model can have: none, offset, affine, all.
inline constexpr std::array<int, 4> kModelTerms = {0, 1, 3, kFieldTerms};

/// A field with some of the terms, fitted to the inliers.
struct FieldModel {
  int terms = 0;
  RowField field;
  double chi_square = 0;  ///< sum of the capped squares of the residuals over their variances
  double deviation = 0;   ///< predicted standard deviation of the field where it is largest [px]
};

/// All models of one set of matches.
struct FieldFit {
  int inliers = 0;            ///< matches within kInlierLimit of the model with all terms
  int occupied_cells = 0;     ///< of 4x3 cells of the image, those with at least two inliers
  double negative_share = 0;  ///< fraction of the inliers with a disparity below -1 px
  double residual = 0;        ///< robust standard deviation of the inliers about that model [px]
  std::array<FieldModel, kModelTerms.size()> models;

  const FieldModel& full() const { return models.back(); }
};

/// Memory that successive fits share.
struct FitScratch {
  std::vector<FieldFactors> factors;
  std::vector<double> residuals;
  std::vector<double> sorted;
  std::vector<double> weights;
  std::vector<double> variances;

  /// Reserves the memory for this many matches.
  void reserve(std::size_t matches);
};

/// Fits all models. There is no fit, 0 inliers, for less than 6 matches. The same matches always
/// give the same result.
FieldFit fit_field(std::span<const Match> matches, int width, int height, FitScratch& scratch);

}  // namespace mtstereo
