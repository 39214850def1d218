// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/moving_edges.hpp"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace mtstereo::eval {
namespace {

constexpr double kJump = 2;   // between neighboring pixels [px]
constexpr int kReach = 5;     // of the pixels near a jump [px]
constexpr double kWrong = 3;  // error of a wrong disparity [px]
constexpr double kSame = 1;   // largest error of a stale one [px]

// How many frames ago a disparity was true; 0 if it was not.
int age_of(float disparity, cv::Point pixel, const std::vector<cv::Mat>& truths, double scale) {
  const int last = static_cast<int>(truths.size()) - 1;
  for (int age = 1; age <= last; ++age) {
    const double error = disparity - truths[last - age].at<float>(pixel);
    if (std::abs(error) <= kSame * scale) return age;
  }
  return 0;
}

}  // namespace

cv::Mat find_edges(const cv::Mat& truth) {
  const cv::Mat cross = cv::getStructuringElement(cv::MORPH_CROSS, {3, 3});
  const int side = 2 * kReach + 1;
  cv::Mat change, edges;
  cv::morphologyEx(cv::max(truth, 0), change, cv::MORPH_GRADIENT, cross);
  cv::dilate(change > kJump, edges, cv::Mat::ones(side, side, CV_8UC1));
  return edges;
}

EdgeErrors measure_edges(const cv::Mat& map, const std::vector<cv::Mat>& truths, double scale) {
  const cv::Mat& truth = truths.back();
  const cv::Mat edges = find_edges(truth / scale);
  double known = 0, wrong = 0, stale = 0, ages = 0;
  for (int y = 0; y < map.rows; ++y) {
    for (int x = 0; x < map.cols; ++x) {
      const float disparity = map.at<float>(y, x);
      const double error = std::abs(disparity - truth.at<float>(y, x)) / scale;
      if (edges.at<std::uint8_t>(y, x) == 0 || std::isnan(error)) continue;
      known += 1;
      if (error <= kWrong) continue;
      wrong += 1;
      const int age = age_of(disparity, {x, y}, truths, scale);
      stale += age > 0 ? 1 : 0;
      ages += age;
    }
  }
  if (known == 0) return {};
  return {100 * wrong / known, 100 * stale / known, stale > 0 ? ages / stale : kNone};
}

}  // namespace mtstereo::eval
