// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/flat_answers.hpp"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "lib/outputs/user_error.hpp"

namespace mtstereo::eval {
namespace {

// 255 where the window around a pixel is constant.
cv::Mat flat_areas(const cv::Mat& image) {
  const cv::Mat window = cv::Mat::ones(kFlatWindow, kFlatWindow, CV_8UC1);
  cv::Mat least, most;
  cv::erode(image, least, window);
  cv::dilate(image, most, window);
  return least == most;
}

}  // namespace

std::int64_t count_flat_answers(const cv::Mat& disparity, const cv::Mat& left,
                                const cv::Mat& right) {
  if (disparity.size() != left.size() || disparity.size() != right.size()) {
    throw UserError("disparity map and images have different sizes");
  }
  const cv::Mat flat_left = flat_areas(left), flat_right = flat_areas(right);
  std::int64_t count = 0;
  for (int y = 0; y < disparity.rows; ++y) {
    const auto* found = disparity.ptr<float>(y);
    const auto* here = flat_left.ptr<std::uint8_t>(y);
    const auto* there = flat_right.ptr<std::uint8_t>(y);
    for (int x = 0; x < disparity.cols; ++x) {
      if (here[x] == 0 || std::isnan(found[x])) continue;
      const long at = std::lround(static_cast<float>(x) - found[x]);
      if (at >= 0 && at < disparity.cols && there[at] != 0) ++count;
    }
  }
  return count;
}

}  // namespace mtstereo::eval
