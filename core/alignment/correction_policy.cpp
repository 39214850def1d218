// SPDX-License-Identifier: LGPL-2.1-or-later
#include "alignment/correction_policy.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "alignment/corner_grid.hpp"
#include "alignment/row_field.hpp"

namespace mtstereo {
namespace {

/// Whether a match of the one view is also one of the other: the same place and disparity.
bool is_among(const Match& match, std::span<const Match> others) {
  constexpr float kNear = 1.5F;  // [px]
  return std::any_of(others.begin(), others.end(), [&](const Match& other) {
    return std::abs(match.x_left - other.x_left) <= kNear &&
           std::abs(match.y_left - other.y_left) <= kNear &&
           std::abs(match.x_right - other.x_right) <= kNear;
  });
}

bool same_scene(std::span<const Match> a, std::span<const Match> b) {
  const auto common =
      std::count_if(a.begin(), a.end(), [&](const Match& match) { return is_among(match, b); });
  return static_cast<double>(common) >= kSameScene * static_cast<double>(a.size());
}

}  // namespace

CorrectionPolicy::CorrectionPolicy() {
  pool_.reserve(kPooledViews + 1);
  spare_.resize(kPooledViews + 1);
  for (Matches& matches : spare_) matches.reserve(kMostCorners);
  together_.reserve(kPooledViews * std::size_t{kMostCorners});
  scratch_.reserve(together_.capacity());
  history_.reserve(kHistory + 1);
  blurs_.reserve(kHistory + 1);
}

void CorrectionPolicy::reset() {
  for (Matches& matches : pool_) spare_.push_back(std::move(matches));
  pool_.clear();
  history_.clear();
  blurs_.clear();
  correction_ = {};
  trusted_ = restored_ = swapped_ = false;
  needed_ = 1;
  agreeing_ = contradicted_ = 0;
}

void CorrectionPolicy::restore(const RowField& field) {
  reset();
  correction_.rows = field;
  trusted_ = restored_ = true;
  needed_ = kNeededAfterDisagreement;
}

int CorrectionPolicy::count(bool Finding::*what) const {
  return static_cast<int>(std::count_if(history_.begin(), history_.end(),
                                        [&](const Finding& finding) { return finding.*what; }));
}

bool CorrectionPolicy::not_a_pair() const {
  return count(&Finding::unrelated) >= kNeededNotAPair && count(&Finding::matched) == 0;
}

bool CorrectionPolicy::out_of_step() const { return count(&Finding::unsteady) >= kNeededOutOfStep; }

/// Adds the matches to the pool. Those of a scene that is in the pool replace the older ones, since
/// both have the same errors.
void CorrectionPolicy::pool(std::span<const Match> matches) {
  const auto same = std::find_if(pool_.begin(), pool_.end(), [&](const Matches& pooled) {
    return same_scene(matches, pooled);
  });
  if (same != pool_.end()) {
    same->assign(matches.begin(), matches.end());
    std::rotate(same, same + 1, pool_.end());
    return;
  }
  pool_.push_back(std::move(spare_.back()));
  spare_.pop_back();
  pool_.back().assign(matches.begin(), matches.end());
  if (pool_.size() <= kPooledViews) return;
  spare_.push_back(std::move(pool_.front()));
  pool_.erase(pool_.begin());
}

FieldChoice CorrectionPolicy::fit_pool() {
  together_.clear();
  for (const Matches& matches : pool_) {
    together_.insert(together_.end(), matches.begin(), matches.end());
  }
  const FieldFit fit = fit_field(together_, width_, height_, scratch_);
  const double floor = correction_.rows == RowField() ? kFieldFloor : kKeptField;
  return choose_field(fit, static_cast<int>(together_.size()), 0, floor, width_, height_);
}

void CorrectionPolicy::apply(const RowField& field) {
  trusted_ = true;
  const bool both = !(field == RowField()) && !(correction_.rows == RowField());
  if (both && rms_difference(field, correction_.rows, width_, height_) < kSmallestChange) return;
  correction_.rows = field;
}

/// Forgets the field, and requires several estimates that agree before the next one.
void CorrectionPolicy::withdraw() {
  if (!restored_ && trusted_) {
    correction_.rows = {};
    trusted_ = false;
  }
  for (Matches& matches : pool_) spare_.push_back(std::move(matches));
  pool_.clear();
  needed_ = kNeededAfterDisagreement;
  agreeing_ = contradicted_ = 0;
}

void CorrectionPolicy::add_estimate(const PairFindings& findings, std::span<const Match> matches,
                                    Finding& finding) {
  const auto differs = [&](const RowField& field) {
    return rms_difference(findings.field, field, width_, height_) > kAgreement;
  };
  const bool first = agreeing_ == 0;
  if (!first && differs(agreeing_ < needed_ || !trusted_ ? last_ : correction_.rows)) {
    finding.unsteady = true;
    if (trusted_ && views() >= kEstablishedViews && contradicted_++ == 0) return;
    withdraw();
  }
  contradicted_ = 0;
  last_ = findings.field;
  ++agreeing_;
  pool(matches);
  if (agreeing_ < needed_) return;
  const FieldChoice choice = fit_pool();
  if (choice.status != FieldStatus::kTrusted) return;
  restored_ = false;
  apply(choice.model.field);
}

void CorrectionPolicy::add_sharpness(const PairFindings& findings) {
  if (findings.sharpness_ratio <= 0) return;
  if (blurs_.size() == kHistory) blurs_.erase(blurs_.begin());
  blurs_.push_back(findings.left_blur - findings.right_blur);
  std::array<float, kHistory> sorted{};
  std::copy(blurs_.begin(), blurs_.end(), sorted.begin());
  const auto end = sorted.begin() + static_cast<std::ptrdiff_t>(blurs_.size());
  std::sort(sorted.begin(), end);
  const float median = sorted[(blurs_.size() - 1) / 2];
  constexpr float kSmallestBlurChange = 0.1F;
  const float now = correction_.left_blur - correction_.right_blur;
  if (median != 0 && std::abs(median - now) < kSmallestBlurChange) return;
  correction_.left_blur = std::max(median, 0.0F);
  correction_.right_blur = median < 0 ? -median : 0;
}

void CorrectionPolicy::add(const PairFindings& findings, std::span<const Match> matches, int width,
                           int height) {
  if (width_ > 0 && (width != width_ || height != height_)) reset();
  width_ = width;
  height_ = height;
  Finding finding;
  finding.matched = findings.inliers >= kFewestInliers;
  finding.unrelated = findings.candidates >= kFewestCandidates &&
                      findings.inliers < kChanceInliers && findings.inlier_share < kChanceShare;
  swapped_ =
      findings.status == FieldStatus::kSwapped || (swapped_ && findings.inliers < kFewestInliers);
  if (findings.status == FieldStatus::kTrusted) {
    add_estimate(findings, matches, finding);
  } else if (findings.status == FieldStatus::kTooFewInliers ||
             findings.status == FieldStatus::kTooScattered) {
    finding.unsteady = findings.matches >= kFewestInliers;
    // A single estimate of views that are out of step can look good; others then do not.
    constexpr int kPatience = 2;
    if (views() < kEstablishedViews && ++contradicted_ >= kPatience) withdraw();
  }
  add_sharpness(findings);
  if (history_.size() == kHistory) history_.erase(history_.begin());
  history_.push_back(finding);
}

}  // namespace mtstereo
