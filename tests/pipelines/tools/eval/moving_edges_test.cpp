// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/moving_edges.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace mtstereo::eval::moving_edges_test {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr int kWidth = 40;

/// An object at 20 px, from this column on, before a wall at 8 px.
cv::Mat scene(int object) {
  cv::Mat truth(1, kWidth, CV_32FC1, 8.0F);
  truth.colRange(object, kWidth) = 20.0F;
  return truth;
}

TEST(MovingEdges, AreWithinFivePixelsOfAJump) {
  const cv::Mat edges = find_edges(scene(20));
  EXPECT_EQ(cv::countNonZero(edges), 12);
  EXPECT_NE(edges.at<std::uint8_t>(0, 14), 0);
  EXPECT_NE(edges.at<std::uint8_t>(0, 25), 0);
}

TEST(MovingEdges, ATrueMapHasNoErrors) { EXPECT_EQ(wrong_at_edges(scene(24), scene(24)), 0); }

TEST(MovingEdges, AMapOfAnEarlierFrameIsWrong) {
  EXPECT_NEAR(wrong_at_edges(scene(20), scene(24)), 100.0 * 4 / 12, 1e-9);
}

TEST(MovingEdges, UnknownPixelsDoNotCount) {
  cv::Mat map = scene(24);
  map.at<float>(0, 23) = 14;
  map.at<float>(0, 22) = kNaN;
  EXPECT_NEAR(wrong_at_edges(map, scene(24)), 100.0 / 11, 1e-9);
}

TEST(MovingEdges, AreMeasuredInPixelsOfTheOriginal) {
  EXPECT_TRUE(std::isnan(wrong_at_edges(scene(20), scene(24), 8)))
      << "a jump of 1.5 px of the original is no edge";
  EXPECT_EQ(wrong_at_edges(scene(20), scene(24), 5), 0) << "2.4 px of the original";
}

TEST(MovingEdges, ASceneWithoutEdgesHasNoFigures) {
  EXPECT_TRUE(std::isnan(wrong_at_edges(scene(kWidth), scene(kWidth))));
}

}  // namespace
}  // namespace mtstereo::eval::moving_edges_test
