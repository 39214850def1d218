// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/exponential_filter.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace mtstereo::eval::exponential_filter_test {
namespace {

using ::testing::FloatEq;
using ::testing::Pointwise;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// What a pixel has after each of these disparities; 0 = unknown.
std::vector<float> filtered(const std::vector<float>& disparities) {
  ExponentialFilter filter;
  std::vector<float> result;
  for (const float disparity : disparities) {
    const cv::Mat map(2, 3, CV_32FC1, cv::Scalar(disparity == 0 ? kNaN : disparity));
    const float value = filter.filtered(map).at<float>(1, 2);
    result.push_back(std::isnan(value) ? 0 : value);
  }
  return result;
}

TEST(ExponentialFilter, IsAMeanOfDisparitiesThatAreNear) {
  EXPECT_THAT(filtered({10, 10.5F, 10}), Pointwise(FloatEq(), std::vector{10.0F, 10.2F, 10.12F}));
}

TEST(ExponentialFilter, BeginsAnewWithAJump) {
  EXPECT_EQ((std::vector<float>{10, 11, 11}), filtered({10, 11, 11}));
  EXPECT_EQ((std::vector<float>{0, 0, 7}), filtered({0, 0, 7}));
}

TEST(ExponentialFilter, KeepsWhatWasKnownInTwoOfTheLastFourMaps) {
  EXPECT_EQ((std::vector<float>{10, 0}), filtered({10, 0}));
  EXPECT_EQ((std::vector<float>{10, 10, 10, 10, 10, 0}), filtered({10, 10, 0, 0, 0, 0}));
  EXPECT_EQ((std::vector<float>{10, 0, 0, 10, 10, 0}), filtered({10, 0, 0, 10, 0, 0}));
}

TEST(ExponentialFilter, BeginsAnewWithAnotherSizeAndLeavesTheMapsAsTheyAre) {
  ExponentialFilter filter;
  const cv::Mat first(1, 2, CV_32FC1, cv::Scalar(10)), second(2, 1, CV_32FC1, cv::Scalar(10.5F));
  EXPECT_EQ(10, filter.filtered(first).at<float>(0, 1));
  EXPECT_EQ(10.5F, filter.filtered(second).at<float>(1, 0));
  EXPECT_EQ(10.5F, second.at<float>(1, 0));
}

}  // namespace
}  // namespace mtstereo::eval::exponential_filter_test
