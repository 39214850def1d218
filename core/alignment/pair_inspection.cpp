// SPDX-License-Identifier: LGPL-2.1-or-later
#include "alignment/pair_inspection.hpp"

#include <algorithm>
#include <utility>

#include "alignment/patch_tracking.hpp"

namespace mtstereo {
namespace {

/// Full pixels as pixels of the reduced view, rounded up.
int reduced(int length, int factor) { return (length + factor - 1) / factor; }

/// The full pixel in the middle of a reduced one.
int middle(int at, int factor) { return at * factor + factor / 2; }

}  // namespace

void PairInspector::search(GrayView left, GrayView right, int least_disparity, int most_disparity) {
  const int factor = reduced_left_.factor;
  const SearchWindow window = {-reduced(-least_disparity, factor), reduced(most_disparity, factor),
                               reduced(kSearchedRows, factor)};
  const auto reach = static_cast<float>(factor + 1);
  matches_.clear();
  repeated_ = 0;
  for (const Corner& corner : corners_) {
    const Place place = find_in_right_view(reduced_left_.gray, reduced_right_.gray, corner, window,
                                           search_scratch_);
    repeated_ += place.outcome == Place::Outcome::kRepeated ? 1 : 0;
    if (!place.found()) continue;
    const auto match = track_patch(left, right, middle(corner.x, factor), middle(corner.y, factor),
                                   static_cast<float>(middle(place.x, factor)),
                                   static_cast<float>(middle(place.y, factor)), reach);
    if (match) matches_.push_back(*match);
  }
}

void PairInspector::find_matches(GrayView left, GrayView right, int max_disparity) {
  const int most = std::min(max_disparity, left.width);
  reduced_left_.reduce(left);
  reduced_right_.reduce(right);
  const double deviation =
      kHighPassGain * noise_of(left, sharpness_scratch_) / reduced_left_.factor;
  find_corners(reduced_left_.gray, static_cast<float>(deviation * deviation), corner_scratch_,
               corners_);
  search(left, right, least_disparity_ - kSearchedNegative, most);
  constexpr double kEnough = 0.2;
  if (matches_.size() >= kEnough * corners_.size() || most <= kSearchedNegative) return;
  // The views may be swapped.
  std::swap(matches_, other_matches_);
  search(left, right, least_disparity_ - most, most);
  if (matches_.size() < other_matches_.size()) std::swap(matches_, other_matches_);
}

/// Compares the sharpness. If it differs, replaces the sharper view by a blurred copy.
bool PairInspector::even_out_sharpness(GrayView& left, GrayView& right) {
  const bool few = matches_.size() < kFewestPatches;
  if (few) spread_patches(left.width, left.height, other_matches_);
  const SharpnessDifference sharpness =
      compare_sharpness(left, right, few ? other_matches_ : matches_, sharpness_scratch_);
  findings_.sharpness_ratio = sharpness.ratio;
  findings_.left_blur = sharpness.left_blur;
  findings_.right_blur = sharpness.right_blur;
  const float sigma = std::max(sharpness.left_blur, sharpness.right_blur);
  if (sigma <= 0) return false;
  GrayView& sharper = sharpness.left_blur > 0 ? left : right;
  blurred_.resize(sharper.width, sharper.height);
  blur_rows(sharper, gaussian_kernel(sigma), 0, sharper.height, sharpness_scratch_.blur, blurred_);
  sharper = blurred_.view();
  return true;
}

void PairInspector::judge(int width, int height) {
  // Only the sign of a disparity matters from here on.
  for (Match& match : matches_) match.x_left -= static_cast<float>(least_disparity_);
  findings_.candidates = static_cast<int>(corners_.size());
  findings_.matches = static_cast<int>(matches_.size());
  if (findings_.candidates < kFewestInliers) {
    findings_.status = FieldStatus::kTooFewCorners;
    return;
  }
  const FieldFit fit = fit_field(matches_, width, height, fit_scratch_);
  const FieldChoice choice =
      choose_field(fit, findings_.matches, repeated_, kFieldFloor, width, height);
  findings_.status = choice.status;
  findings_.inliers = fit.inliers;
  if (findings_.matches > 0) {
    findings_.inlier_share = static_cast<double>(fit.inliers) / findings_.matches;
  }
  findings_.negative_share = fit.negative_share;
  findings_.residual = fit.residual;
  findings_.field = choice.model.field;
  findings_.terms = choice.model.terms;
  findings_.deviation = choice.model.deviation;
}

void PairInspector::inspect(GrayView left, GrayView right, int max_disparity, int least_disparity) {
  findings_ = {};
  least_disparity_ = std::max(least_disparity, -left.width);
  matches_.clear();
  corners_.clear();
  repeated_ = 0;
  if (left.width < kFewestColumns || left.height < kFewestRows) {
    findings_.status = FieldStatus::kImageTooSmall;
    return;
  }
  matches_.reserve(kMostCorners);
  other_matches_.reserve(kMostCorners);
  corners_.reserve(kMostCorners);
  fit_scratch_.reserve(kMostCorners);
  find_matches(left, right, max_disparity);
  if (even_out_sharpness(left, right)) {
    // Views of equal sharpness have more matches, and more exact ones.
    find_matches(left, right, max_disparity);
  }
  judge(left.width, left.height);
  if (findings_.inliers >= kFewestPatches) return;
  // The views need not show the same.
  findings_.sharpness_ratio = 0;
  findings_.left_blur = findings_.right_blur = 0;
}

}  // namespace mtstereo
