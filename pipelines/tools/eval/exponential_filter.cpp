// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/exponential_filter.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace mtstereo::eval {

cv::Mat ExponentialFilter::filtered(const cv::Mat& map) {
  constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
  constexpr unsigned kMaps = 0xf;  // bits of the last four
  if (map.size() != last_.size()) {
    last_ = cv::Mat(map.size(), CV_32FC1, cv::Scalar(kUnknown));
    history_ = cv::Mat::zeros(map.size(), CV_8UC1);
  }
  cv::Mat result(map.size(), CV_32FC1);
  for (int y = 0; y < map.rows; ++y) {
    for (int x = 0; x < map.cols; ++x) {
      const float now = map.at<float>(y, x);
      float& last = last_.at<float>(y, x);
      auto& history = history_.at<std::uint8_t>(y, x);
      const bool persists = std::popcount(history & kMaps) >= 2;
      history = static_cast<std::uint8_t>(history << 1);
      if (std::isnan(now)) {
        result.at<float>(y, x) = persists ? last : kUnknown;
        continue;
      }
      history |= 1;
      const bool near = std::abs(now - last) < kDelta;  // false if nothing was known
      last = near ? kAlpha * now + (1 - kAlpha) * last : now;
      result.at<float>(y, x) = last;
    }
  }
  return result;
}

}  // namespace mtstereo::eval
