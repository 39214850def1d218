// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/inputs/view_match.hpp"

#include <algorithm>
#include <cmath>

#include "alignment/field_fit.hpp"
#include "alignment/pair_inspection.hpp"
#include "recordings/media/sample_frames.hpp"

namespace mtstereo::run {
namespace {

constexpr double kLeastShare = 0.12;
constexpr int kLeastAgreeing = 25;
constexpr double kAlignedRows = 2;  // [px]

double value_at(std::vector<float> values, double fraction) {
  if (values.empty()) return 0;
  const auto at = values.begin() + std::lround(fraction * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

double ViewMatch::share() const {
  return corners > 0 ? static_cast<double>(agreeing) / corners : 0;
}

bool ViewMatch::confirmed() const { return share() >= kLeastShare && agreeing >= kLeastAgreeing; }

bool ViewMatch::aligned() const {
  return confirmed() && row_at(1 - kRowOutliers) - row_at(kRowOutliers) <= kAlignedRows;
}

double ViewMatch::row_at(double fraction) const { return value_at(rows, fraction); }

double ViewMatch::disparity_at(double fraction) const { return value_at(disparities, fraction); }

bool is_better_order(const ViewMatch& other, const ViewMatch& now) {
  constexpr double kFactor = 2;
  if (!other.aligned()) return false;
  return other.share() >= (now.aligned() ? kFactor : 1) * now.share();
}

struct ViewMatcher::State {
  PairInspector inspector;
  FitScratch scratch;
};

ViewMatcher::ViewMatcher() : state_(std::make_unique<State>()) {}

ViewMatcher::~ViewMatcher() = default;

void ViewMatcher::add(const cv::Mat& left, const cv::Mat& right, SearchRange range,
                      ViewMatch& match) {
  if (left.empty() || left.size() != right.size()) return;
  const int least = std::min(range.least, 0);
  state_->inspector.inspect(view_of(left), view_of(right), range.most, least);
  const PairFindings& found = state_->inspector.findings();
  match.corners += found.candidates;
  match.agreeing += static_cast<int>(std::lround(found.inliers * (1 - found.negative_share)));
  const auto matches = state_->inspector.matches();
  if (found.inliers == 0) return;
  const RowField field = fit_field(matches, left.cols, left.rows, state_->scratch).full().field;
  for (const Match& each : matches) {
    const double expected = field.displacement(each.x_right, each.y_left, left.cols, left.rows);
    if (std::abs(each.rows - expected) >= kInlierLimit) continue;
    match.rows.push_back(each.rows);
    match.disparities.push_back(each.disparity() + static_cast<float>(least));
  }
}

}  // namespace mtstereo::run
