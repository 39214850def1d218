// SPDX-License-Identifier: LGPL-2.1-or-later
// Walls at known distances.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <stdexcept>

#include "tools/render/raw.hpp"
#include "tools/render/render.hpp"
#include "tools/render/scene.hpp"

namespace mtstereo::render::wall_test {
namespace {

Settings camera() {
  Settings s;
  s.width = 96, s.height = 64, s.noise = 0, s.samples = 1, s.focal = 90, s.baseline = 0.1;
  return s;
}

Truth truth_of(const Wall& wall) {
  return render_truth(make_wall(wall, 1), 0, camera(), rectification_of(camera()));
}

TEST(Wall, FillsTheViewAtItsDistance) {
  const Truth truth = truth_of({{3.5}, 0});
  EXPECT_LT(cv::norm(truth.depth, cv::Mat(64, 96, CV_32FC1, cv::Scalar(3.5)), cv::NORM_INF), 1e-6);
}

TEST(Wall, SlantMakesTheRightSideFarther) {
  const Truth truth = truth_of({{2}, 30});
  for (const int x : {0, 30, 95}) {
    const double across = (x - 47.5) / 90;
    EXPECT_NEAR(truth.depth.at<float>(20, x), 2 / (1 - across * std::tan(M_PI / 6)), 1e-5);
  }
}

TEST(Wall, SeveralStandSideBySideWithoutGaps) {
  const Wall wall{{3, 1, 2, 5}, 0};
  const Truth truth = truth_of(wall);
  const StereoFrame frame = render(make_wall(wall, 1), 0, camera());
  for (int i = 0; i < 4; ++i) {
    const int x = static_cast<int>(47.5 + 90 * ((i + 0.5) / 4 - 0.5));
    EXPECT_FLOAT_EQ(truth.depth.at<float>(32, x),
                    static_cast<float>(wall.distances[static_cast<std::size_t>(i)]));
  }
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(cv::countNonZero(truth.depth == infinity), 0);
  // The sky is brighter than any wall.
  double darkest = 0, brightest = 0;
  cv::minMaxLoc(frame.right, &darkest, &brightest);
  EXPECT_LT(brightest, 235);
}

TEST(Wall, HasTextureAtEveryDistance) {
  for (const double distance : {0.5, 5.0, 50.0}) {
    const StereoFrame frame = render(make_wall({{distance}, 0}, 1), 0, camera());
    cv::Scalar mean, deviation;
    cv::meanStdDev(frame.left, mean, deviation);
    EXPECT_GT(deviation[0], 15) << distance << " m";
  }
}

TEST(Wall, RefusesInvalidSettings) {
  EXPECT_THROW(make_wall({{}, 0}, 1), std::invalid_argument);
  EXPECT_THROW(make_wall({{0}, 0}, 1), std::invalid_argument);
  EXPECT_THROW(make_wall({{std::nan("")}, 0}, 1), std::invalid_argument);
  EXPECT_THROW(make_wall({{2}, 80}, 1), std::invalid_argument);
  EXPECT_THROW(make_wall({{2, 3}, 10}, 1), std::invalid_argument);
}

}  // namespace
}  // namespace mtstereo::render::wall_test
