// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/flicker.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "expect_error.hpp"

namespace mtstereo::eval::flicker_test {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

cv::Mat row(std::vector<float> values) { return cv::Mat(values, true).reshape(1, 1); }

TEST(Flicker, CountsPixelsThatComeAndGo) {
  // One pixel is in both maps, one in the first, one in the second, and one in none.
  const Flicker flicker = measure_flicker({row({5, 6, kNaN, kNaN}), row({5, kNaN, 7, kNaN})});
  EXPECT_NEAR(flicker.come_and_go, 100.0 * 2 / 3, 1e-9);
  EXPECT_NEAR(flicker.density, 50, 1e-9);
  EXPECT_EQ(flicker.spread, 0);
}

// Feature: filter of disparities over time
TEST(Flicker, SpreadIsThatOfPixelsInAllMaps) {
  const Flicker flicker = measure_flicker({row({5, 10, 1}), row({7, 10, kNaN}), row({9, 10, 100})});
  EXPECT_NEAR(flicker.spread, std::sqrt(8.0 / 3) / 2, 1e-6);
  EXPECT_NEAR(flicker.come_and_go, 100.0 / 3, 1e-9);
}

TEST(Flicker, OfEqualMapsIsNone) {
  const Flicker flicker = measure_flicker({row({5, kNaN}), row({5, kNaN})});
  EXPECT_EQ(flicker.come_and_go, 0);
  EXPECT_EQ(flicker.spread, 0);
}

TEST(Flicker, OfEmptyMapsIsUnknown) {
  const Flicker flicker = measure_flicker({row({kNaN}), row({kNaN})});
  EXPECT_EQ(flicker.density, 0);
  EXPECT_TRUE(std::isnan(flicker.come_and_go));
  EXPECT_TRUE(std::isnan(flicker.spread));
}

TEST(Flicker, NeedsMapsOfOneSize) {
  EXPECT_INPUT_ERROR(measure_flicker({row({1})}), "at least two");
  EXPECT_INPUT_ERROR(measure_flicker({row({1}), row({1, 2})}), "different sizes");
}

TEST(Flicker, MeanIgnoresUnknownFigures) {
  const Flicker result = mean({{40, 10, 0.1}, {20, kNone, kNone}});
  EXPECT_EQ(result.density, 30);
  EXPECT_EQ(result.come_and_go, 10);
  EXPECT_EQ(result.spread, 0.1);
}

TEST(FlickerWindow, IsThatOfTheLastMaps) {
  FlickerWindow window;
  const GroundTruth none{row({kNaN, kNaN}), {}}, near{row({4, 20}), {}}, far{row({90, 20}), {}};
  window.add(row({5, 6}), far);
  for (int i = 1; i < kFlickerFrames; ++i) {
    EXPECT_FALSE(window.measure()) << i;
    window.add(row({5, kNaN}), i == 1 ? none : near);
  }
  EXPECT_NEAR(window.measure()->come_and_go, 50, 1e-9);
  window.add(row({5, kNaN}), near);
  const Flicker flicker = *window.measure();
  EXPECT_EQ(flicker.come_and_go, 0) << "the first map has left";
  EXPECT_EQ(flicker.density, 50);
  EXPECT_EQ(flicker.avgerr, 1) << "unknown errors do not count";
  EXPECT_EQ(flicker.d_all, 0);
  EXPECT_EQ(flicker.edges, 0);
}

TEST(Flicker, NoiseIsFreshInEachFrameAndView) {
  const cv::Mat gray(50, 50, CV_8UC1, cv::Scalar(100));
  std::vector<cv::Mat> images;
  for (const int frame : {0, 1, 0}) {
    cv::Mat left = gray.clone(), right = gray.clone();
    add_flicker_noise(3, frame, left, right);
    images.push_back(left);
    images.push_back(right);
  }
  EXPECT_EQ(cv::norm(images[0], images[4], cv::NORM_INF), 0) << "the same in every run";
  for (const auto& [a, b] : {std::pair(0, 1), {0, 2}, {1, 2}, {2, 3}}) {
    EXPECT_GT(cv::norm(images[a], images[b], cv::NORM_INF), 5) << a << ' ' << b;
  }
}

}  // namespace
}  // namespace mtstereo::eval::flicker_test
