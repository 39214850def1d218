// SPDX-License-Identifier: LGPL-2.1-or-later
#include "thin_structures.hpp"

#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "lib/outputs/user_error.hpp"

namespace mtstereo::tests {
namespace {

double share(std::int64_t part, std::int64_t all) {
  return all == 0 ? 0 : 100.0 * static_cast<double>(part) / static_cast<double>(all);
}

/// 255 where there is no truth. OpenCV's comparisons do not find NaN.
cv::Mat unknown_in(const cv::Mat& truth) {
  cv::Mat unknown(truth.size(), CV_8UC1);
  for (int y = 0; y < truth.rows; ++y) {
    for (int x = 0; x < truth.cols; ++x) {
      unknown.at<std::uint8_t>(y, x) = std::isnan(truth.at<float>(y, x)) ? 255 : 0;
    }
  }
  return unknown;
}

/// The truth without what is narrower than a line of this size.
cv::Mat opened(const cv::Mat& truth, const cv::Mat& unknown, cv::Size line) {
  constexpr float kFar = std::numeric_limits<float>::max();
  const cv::Mat kernel = cv::Mat::ones(line, CV_8UC1);
  cv::Mat result = truth.clone();
  result.setTo(kFar, unknown);
  cv::erode(result, result, kernel);
  result.setTo(-kFar, unknown);
  cv::dilate(result, result, kernel);
  return result;
}

}  // namespace

double ThinCounts::recall() const { return share(found, thin); }
double ThinCounts::painted_over() const { return share(painted, thin); }
double ThinCounts::rim_share() const { return share(false_rim, rim); }
double ThinCounts::far_share() const { return share(false_far, far); }

ThinCounts& operator+=(ThinCounts& sum, const ThinCounts& counts) {
  sum.thin += counts.thin;
  sum.found += counts.found;
  sum.painted += counts.painted;
  sum.rim += counts.rim;
  sum.false_rim += counts.false_rim;
  sum.far += counts.far;
  sum.false_far += counts.false_far;
  return sum;
}

cv::Mat background_of(const cv::Mat& truth) {
  constexpr int kLine = kMostThin + 1;
  const cv::Mat unknown = unknown_in(truth);
  cv::Mat background;
  cv::min(opened(truth, unknown, {kLine, 1}), opened(truth, unknown, {1, kLine}), background);
  background.setTo(std::numeric_limits<float>::quiet_NaN(), unknown);
  return background;
}

ThinCounts measure_thin(const cv::Mat& estimate, const cv::Mat& truth) {
  if (estimate.size() != truth.size()) {
    throw UserError("the disparity map and the ground truth have different sizes");
  }
  const cv::Mat background = background_of(truth);
  const cv::Mat above = truth - background;
  cv::Mat thin = above > kThinStep, near;
  constexpr int kRim = 2 * kThinRim + 1;
  cv::dilate(thin, near, cv::Mat::ones(kRim, kRim, CV_8UC1));
  ThinCounts counts;
  for (int y = 0; y < truth.rows; ++y) {
    for (int x = 0; x < truth.cols; ++x) {
      const float true_one = truth.at<float>(y, x), found = estimate.at<float>(y, x);
      if (std::isnan(true_one)) continue;
      if (thin.at<std::uint8_t>(y, x) != 0) {
        const bool right = std::abs(found - true_one) <= 0.1F * true_one;
        ++counts.thin;
        counts.found += right;
        counts.painted += !right && std::abs(found - background.at<float>(y, x)) <= 1.5F;
        continue;
      }
      const bool too_near = found > true_one + 1;
      const bool is_rim = near.at<std::uint8_t>(y, x) != 0;
      ++(is_rim ? counts.rim : counts.far);
      (is_rim ? counts.false_rim : counts.false_far) += too_near;
    }
  }
  return counts;
}

}  // namespace mtstereo::tests
