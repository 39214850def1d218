// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>
#include <vector>

#include "alignment/coarse_search.hpp"
#include "alignment/corner_grid.hpp"
#include "alignment/field_choice.hpp"
#include "alignment/field_fit.hpp"
#include "alignment/match.hpp"
#include "alignment/reduced_view.hpp"
#include "alignment/sharpness.hpp"
#include "mtstereo/alignment.hpp"

namespace mtstereo {

/// Smaller images are not inspected [px].
inline constexpr int kFewestColumns = 96;
inline constexpr int kFewestRows = 64;

/// Disparities below zero, and displacements of the rows up and down, that are searched [px].
inline constexpr int kSearchedNegative = 16;
inline constexpr int kSearchedRows = 8;

/// Inspects single pairs. Reuses its memory for the next pair.
class PairInspector {
 public:
  /// Estimates the field and the sharpness of a pair of views of the same size. The smallest
  /// disparity of the stereo camera, `least_disparity`, is at most 0.
  void inspect(GrayView left, GrayView right, int max_disparity, int least_disparity = 0);

  const PairFindings& findings() const { return findings_; }
  /// The matches of the last pair, with those that disagree with the field. Their disparities are
  /// relative to the least one.
  std::span<const Match> matches() const { return matches_; }

 private:
  void find_matches(GrayView left, GrayView right, int max_disparity);
  void search(GrayView left, GrayView right, int least_disparity, int most_disparity);
  bool even_out_sharpness(GrayView& left, GrayView& right);
  void judge(int width, int height);

  PairFindings findings_;
  ReducedView reduced_left_, reduced_right_;
  CornerScratch corner_scratch_;
  SearchScratch search_scratch_;
  FitScratch fit_scratch_;
  SharpnessScratch sharpness_scratch_;
  std::vector<Corner> corners_;
  std::vector<Match> matches_, other_matches_;
  Image<std::uint8_t> blurred_;
  int least_disparity_ = 0;
  int repeated_ = 0;  ///< corners that are found at several places
};

}  // namespace mtstereo
