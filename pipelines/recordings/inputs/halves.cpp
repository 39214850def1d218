// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/inputs/halves.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "recordings/inputs/view_match.hpp"
#include "recordings/inputs/view_rectifier.hpp"

namespace mtstereo::run {
namespace {

constexpr double kRangeShare = 0.4;  // of the width: near things in close views too

}  // namespace

std::optional<Arrangement> arrangement_by_shape(int width, int height) {
  // Halves of a side-by-side frame are at least square, views of one camera at most 16:9.
  if (10 * width >= 19 * height) return Arrangement::kSideBySide;
  if (width <= height) return Arrangement::kTopBottom;
  return std::nullopt;
}

cv::Mat half_of(const cv::Mat& frame, Arrangement arrangement, int number, int width) {
  const bool beside = arrangement == Arrangement::kSideBySide;
  const cv::Size size(beside ? frame.cols / 2 : frame.cols, beside ? frame.rows : frame.rows / 2);
  const cv::Mat half = frame({number * (beside ? size.width : 0),
                              number * (beside ? 0 : size.height), size.width, size.height});
  if (half.empty()) return half;
  const double least = 1.0 / std::min(size.width, size.height);  // a strip keeps a row or column
  const double scale = std::clamp(static_cast<double>(width) / size.width, least, 1.0);
  cv::Mat small;
  cv::resize(half, small, {}, scale, scale, cv::INTER_AREA);
  return small;
}

HalvesMatch match_halves(const std::vector<cv::Mat>& frames, Arrangement arrangement,
                         const std::optional<StereoCalibration>& calibration) {
  std::optional<ViewRectifier> left, right;
  if (calibration) {
    left.emplace(*calibration, Rectifier::Side::kLeft);
    right.emplace(*calibration, Rectifier::Side::kRight);
  }
  ViewMatcher matcher;
  ViewMatch forward, backward;
  for (const cv::Mat& frame : frames) {
    const cv::Mat first = half_of(frame, arrangement, 0, kMatchedWidth);
    const cv::Mat second = half_of(frame, arrangement, 1, kMatchedWidth);
    if (first.empty()) continue;
    const SearchRange range{0, static_cast<int>(kRangeShare * first.cols)};
    const auto add = [&](const cv::Mat& a, const cv::Mat& b, ViewMatch& match) {
      matcher.add(left ? left->apply(a) : a, right ? right->apply(b) : b, range, match);
    };
    add(first, second, forward);
    add(second, first, backward);
  }
  return {forward.share(), backward.share(), forward.confirmed() || backward.confirmed(),
          is_better_order(backward, forward)};
}

}  // namespace mtstereo::run
