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

TEST(MovingEdges, ATrueMapHasNoErrors) {
  const EdgeErrors errors = measure_edges(scene(24), {scene(20), scene(24)});
  EXPECT_EQ(errors.wrong, 0);
  EXPECT_EQ(errors.stale, 0);
  EXPECT_TRUE(std::isnan(errors.age));
}

TEST(MovingEdges, AMapOfAnEarlierFrameIsStale) {
  // The object leaves four columns in two frames.
  const std::vector<cv::Mat> truths = {scene(20), scene(22), scene(24)};
  const EdgeErrors errors = measure_edges(scene(20), truths);
  EXPECT_NEAR(errors.wrong, 100.0 * 4 / 12, 1e-9);
  EXPECT_NEAR(errors.stale, errors.wrong, 1e-9);
  EXPECT_NEAR(errors.age, (2 * 2 + 2 * 1) / 4.0, 1e-9);  // columns 20, 21: two frames
}

TEST(MovingEdges, ADisparityThatWasNeverTrueIsWrongButNotStale) {
  cv::Mat map = scene(24);
  map.at<float>(0, 23) = 14;
  map.at<float>(0, 22) = kNaN;
  const EdgeErrors errors = measure_edges(map, {scene(20), scene(24)});
  EXPECT_NEAR(errors.wrong, 100.0 / 11, 1e-9);
  EXPECT_EQ(errors.stale, 0);
}

TEST(MovingEdges, AreMeasuredInPixelsOfTheOriginal) {
  const EdgeErrors errors = measure_edges(scene(20), {scene(20), scene(24)}, 8);
  EXPECT_TRUE(std::isnan(errors.wrong)) << "a jump of 1.5 px of the original is no edge";
  const EdgeErrors small = measure_edges(scene(20), {scene(20), scene(24)}, 5);
  EXPECT_EQ(small.wrong, 0) << "2.4 px of the original";
}

TEST(MovingEdges, ASceneWithoutEdgesHasNoFigures) {
  EXPECT_TRUE(std::isnan(measure_edges(scene(kWidth), {scene(kWidth)}).wrong));
}

}  // namespace
}  // namespace mtstereo::eval::moving_edges_test
