// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>
#include <vector>

#include "alignment/field_choice.hpp"
#include "alignment/field_fit.hpp"
#include "alignment/match.hpp"
#include "mtstereo/alignment.hpp"

namespace mtstereo {

/// Makes a correction of successive inspections, and decides what is wrong with the pairs. See
/// AlignmentTracker.

/// Inspections whose matches are fitted together; later ones replace the oldest.
inline constexpr int kPooledViews = 8;

/// Fields that differ by more than this do not agree [px rms].
inline constexpr double kAgreement = 0.3;

/// A correction made of fewer views than this is withdrawn by the first estimate that does not
/// agree, one of more views by the second in succession.
inline constexpr int kEstablishedViews = 3;

/// Successive estimates that must agree after a disagreement.
inline constexpr int kNeededAfterDisagreement = 3;

/// The correction changes only by more than this [px rms], so that the results of successive pairs
/// do not differ without need.
inline constexpr double kSmallestChange = 0.03;

/// A field stays corrected until it is smaller than this [px rms]; see also kFieldFloor.
inline constexpr double kKeptField = 0.07;

/// A view shows the same scene as another one if this fraction of its matches is there as well.
inline constexpr double kSameScene = 0.3;

/// Inspections from whose results the problems are found, and how many of them must show one.
inline constexpr int kHistory = 5;
inline constexpr int kNeededOutOfStep = 3;
inline constexpr int kNeededNotAPair = 3;

/// Views are unrelated if there are this many candidates, but no more inliers than occur by chance,
/// among matches that disagree. In dark and noisy views the few matches agree.
inline constexpr int kFewestCandidates = 150;
inline constexpr int kChanceInliers = 12;
inline constexpr double kChanceShare = 0.8;

class CorrectionPolicy {
 public:
  CorrectionPolicy();

  /// Starts with a field that applies until other estimates agree on another one.
  void restore(const RowField& field);
  void reset();

  /// Takes the result of an inspection of images of this size, with its matches.
  void add(const PairFindings& findings, std::span<const Match> matches, int width, int height);

  const ViewCorrection& correction() const { return correction_; }
  bool trusted() const { return trusted_; }
  int views() const { return static_cast<int>(pool_.size()); }

  bool swapped() const { return swapped_; }
  bool not_a_pair() const;
  bool out_of_step() const;
  bool sharpness_differs() const { return correction_.left_blur > 0 || correction_.right_blur > 0; }

 private:
  using Matches = std::vector<Match>;

  /// What one inspection says about the pair.
  struct Finding {
    bool unrelated = false;  ///< almost no matches
    bool unsteady = false;   ///< the matches disagree with any field, or with the fields before
    bool matched = false;    ///< there are matches
  };

  void add_estimate(const PairFindings& findings, std::span<const Match> matches, Finding& finding);
  void pool(std::span<const Match> matches);
  FieldChoice fit_pool();
  void apply(const RowField& field);
  void withdraw();
  void add_sharpness(const PairFindings& findings);
  int count(bool Finding::*what) const;

  int width_ = 0;
  int height_ = 0;
  ViewCorrection correction_;
  bool trusted_ = false;
  bool restored_ = false;  ///< the field was restored and not replaced since
  int needed_ = 1;         ///< agreeing estimates before a field applies
  int agreeing_ = 0;       ///< successive estimates that agree with each other
  int contradicted_ = 0;   ///< successive inspections that contradict the field
  RowField last_;          ///< the field of the last trusted estimate
  bool swapped_ = false;
  std::vector<Matches> pool_;  ///< oldest first; the memory of removed ones is in spare_
  std::vector<Matches> spare_;
  Matches together_;
  FitScratch scratch_;
  std::vector<Finding> history_;  ///< oldest first
  std::vector<float> blurs_;      ///< oldest first: of the left view, or minus that of the right
};

}  // namespace mtstereo
