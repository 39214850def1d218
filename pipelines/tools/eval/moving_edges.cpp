// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/moving_edges.hpp"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace mtstereo::eval {
namespace {

constexpr double kJump = 2;   // between neighboring pixels [px]
constexpr int kReach = 5;     // of the pixels near a jump [px]
constexpr double kWrong = 3;  // error of a wrong disparity [px]

}  // namespace

cv::Mat find_edges(const cv::Mat& truth) {
  const cv::Mat cross = cv::getStructuringElement(cv::MORPH_CROSS, {3, 3});
  const int side = 2 * kReach + 1;
  cv::Mat change, edges;
  cv::morphologyEx(cv::max(truth, 0), change, cv::MORPH_GRADIENT, cross);
  cv::dilate(change > kJump, edges, cv::Mat::ones(side, side, CV_8UC1));
  return edges;
}

double wrong_at_edges(const cv::Mat& map, const cv::Mat& truth, double scale) {
  const cv::Mat edges = find_edges(truth / scale);
  double known = 0, wrong = 0;
  for (int y = 0; y < map.rows; ++y) {
    for (int x = 0; x < map.cols; ++x) {
      const double error = std::abs(map.at<float>(y, x) - truth.at<float>(y, x)) / scale;
      if (edges.at<std::uint8_t>(y, x) == 0 || std::isnan(error)) continue;
      known += 1;
      wrong += error > kWrong ? 1 : 0;
    }
  }
  return known > 0 ? 100 * wrong / known : kNone;
}

}  // namespace mtstereo::eval
