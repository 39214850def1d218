// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/background_fill.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace mtstereo::eval::background_fill_test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

void expect_map(const cv::Mat& found, const cv::Mat& wanted) {
  ASSERT_EQ(found.size(), wanted.size());
  for (int y = 0; y < found.rows; ++y) {
    for (int x = 0; x < found.cols; ++x) {
      const float f = found.at<float>(y, x), w = wanted.at<float>(y, x);
      EXPECT_TRUE(f == w || (std::isnan(f) && std::isnan(w)))
          << "at " << x << "," << y << ": " << f << " instead of " << w;
    }
  }
}

TEST(BackgroundFill, GivesGapsTheSmallerSide) {
  const cv::Mat map = (cv::Mat_<float>(2, 6) << 9, kNan, kNan, 4, kNan, 7,  //
                       1, 2, kNan, 3, 4, 5);
  expect_map(fill_background(map), (cv::Mat_<float>(2, 6) << 9, 4, 4, 4, 4, 7,  //
                                    1, 2, 2, 3, 4, 5));
}

TEST(BackgroundFill, ExtendsRowsToTheBorder) {
  const cv::Mat map = (cv::Mat_<float>(1, 6) << kNan, kNan, 8, 5, kNan, kNan);
  expect_map(fill_background(map), (cv::Mat_<float>(1, 6) << 8, 8, 8, 5, 5, 5));
}

TEST(BackgroundFill, CopiesTheFirstAndLastRowButNoneBetween) {
  const cv::Mat map =
      (cv::Mat_<float>(6, 2) << kNan, kNan, kNan, kNan, 3, kNan, kNan, kNan, 5, 6, kNan, kNan);
  expect_map(fill_background(map),
             (cv::Mat_<float>(6, 2) << 3, 3, 3, 3, 3, 3, kNan, kNan, 5, 6, 5, 6));
}

TEST(BackgroundFill, LeavesTheInputAndFullMapsUnchanged) {
  const cv::Mat gaps = (cv::Mat_<float>(1, 2) << kNan, 2);
  fill_background(gaps);
  EXPECT_TRUE(std::isnan(gaps.at<float>(0, 0)));
  const cv::Mat full = (cv::Mat_<float>(2, 2) << 1, 2, 3, 4);
  expect_map(fill_background(full), full);
}

TEST(BackgroundFill, LeavesAMapWithoutDisparityEmpty) {
  const cv::Mat map(3, 4, CV_32FC1, cv::Scalar(kNan));
  expect_map(fill_background(map), map);
}

TEST(BackgroundFill, ReadsMapsWithAStride) {
  cv::Mat large(3, 8, CV_32FC1, cv::Scalar(100));
  cv::Mat part = large.colRange(2, 5);
  part.setTo(kNan);
  part.at<float>(1, 1) = 6;
  expect_map(fill_background(part), cv::Mat(3, 3, CV_32FC1, cv::Scalar(6)));
}

}  // namespace
}  // namespace mtstereo::eval::background_fill_test
