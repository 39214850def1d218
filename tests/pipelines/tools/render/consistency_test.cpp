// SPDX-License-Identifier: LGPL-2.1-or-later
// The built-in scenes: images, ground truth and masks must be consistent.
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <stdexcept>

#include "support/error_of.hpp"
#include "tools/render/render.hpp"

namespace mtstereo::render::consistency_test {
namespace {

Settings clean(int width = 240, int height = 136) {
  Settings s;
  s.width = width, s.height = height, s.noise = 0;
  return s;
}

// Away from depth discontinuities, where a pixel is a mix of two surfaces.
bool smooth_around(const cv::Mat& truth, int x, int y) {
  if (x < 1 || y < 1 || x + 1 >= truth.cols || y + 1 >= truth.rows) return false;
  const float d = truth.at<float>(y, x);
  for (int j = -1; j <= 1; ++j) {
    for (int i = -1; i <= 1; ++i) {
      if (!(std::abs(truth.at<float>(y + j, x + i) - d) < 0.5f)) return false;
    }
  }
  return true;
}

struct WarpError {
  double visible = 0, occluded = 0;  // mean |left - right warped| [gray values]
  int visible_count = 0, occluded_count = 0;
};

WarpError warp_error(const StereoFrame& f, float error_in_truth) {
  WarpError e;
  for (int y = 0; y < f.left.rows; ++y) {
    for (int x = 0; x < f.left.cols; ++x) {
      if (!smooth_around(f.truth, x, y)) continue;
      const float at = static_cast<float>(x) - f.truth.at<float>(y, x) - error_in_truth;
      const int x0 = static_cast<int>(std::floor(at));
      if (x0 < 0 || x0 + 1 >= f.right.cols) continue;
      const float part = at - static_cast<float>(x0);
      const float right =
          (1 - part) * f.right.at<std::uint8_t>(y, x0) + part * f.right.at<std::uint8_t>(y, x0 + 1);
      const double difference = std::abs(right - f.left.at<std::uint8_t>(y, x));
      const bool occluded = f.occluded.at<std::uint8_t>(y, x) != 0;
      (occluded ? e.occluded : e.visible) += difference;
      ++(occluded ? e.occluded_count : e.visible_count);
    }
  }
  e.visible /= std::max(1, e.visible_count);
  e.occluded /= std::max(1, e.occluded_count);
  return e;
}

class BuiltInScene : public ::testing::TestWithParam<const char*> {};

TEST_P(BuiltInScene, RightImageWarpedByTheTruthMatchesTheLeftOne) {
  const Scene scene = make_scene(GetParam(), 1);
  for (const double time : {0.0, 1.25}) {
    const StereoFrame f = render(scene, time, clean());
    const WarpError right = warp_error(f, 0), shifted = warp_error(f, 1);
    EXPECT_GT(right.visible_count, 240 * 136 / 3) << "time " << time;
    EXPECT_LT(right.visible, 2.0) << "time " << time;
    EXPECT_GT(shifted.visible, 1.5 * right.visible)
        << "a wrong ground truth must be detectable, time " << time;
  }
}

TEST_P(BuiltInScene, OccludedPixelsDoNotMatchTheRightImage) {
  const StereoFrame f = render(make_scene(GetParam(), 1), 0.5, clean());
  const WarpError e = warp_error(f, 0);
  EXPECT_GT(e.occluded_count, 50);
  EXPECT_GT(e.occluded, 4 * e.visible);
}

TEST_P(BuiltInScene, DisparitiesArePositiveAndWithinAQuarterOfTheWidth) {
  const Scene scene = make_scene(GetParam(), 3);
  for (const double time : {0.0, 1.0, 2.0}) {
    const StereoFrame f = render(scene, time, clean());
    int known = 0;
    for (int y = 0; y < f.truth.rows; ++y) {
      for (int x = 0; x < f.truth.cols; ++x) {
        const float d = f.truth.at<float>(y, x);
        if (std::isinf(d)) continue;
        ++known;
        ASSERT_GT(d, 0) << x << ", " << y << ", time " << time;
        ASSERT_LT(d, 60) << x << ", " << y << ", time " << time;
      }
    }
    EXPECT_GT(known, f.truth.rows * f.truth.cols / 2);
  }
}

TEST_P(BuiltInScene, ImageHasContrastAndIsNotClipped) {
  const StereoFrame f = render(make_scene(GetParam(), 2), 0, clean());
  cv::Scalar mean, deviation;
  cv::meanStdDev(f.left, mean, deviation);
  EXPECT_GT(deviation[0], 15);
  EXPECT_LT(cv::countNonZero(f.left == 255), f.left.rows * f.left.cols / 50);
  EXPECT_LT(cv::countNonZero(f.left == 0), f.left.rows * f.left.cols / 20);
}

TEST_P(BuiltInScene, MovesOverTime) {
  const Scene scene = make_scene(GetParam(), 1);
  const StereoFrame a = render(scene, 0, clean()), b = render(scene, 0.5, clean());
  EXPECT_GT(cv::norm(a.left, b.left, cv::NORM_L1) / static_cast<double>(a.left.total()), 2);
}

INSTANTIATE_TEST_SUITE_P(All, BuiltInScene, ::testing::Values("street", "garden", "room"),
                         [](const auto& info) { return std::string(info.param); });

TEST(Scenes, EveryNameIsAScene) {
  for (const auto& name : scene_names()) EXPECT_EQ(make_scene(name, 1).name, name);
}

TEST(Scenes, UnknownNameIsRejectedWithAListOfNames) {
  const std::string error = test::error_of<std::invalid_argument>([] { make_scene("moon", 1); });
  EXPECT_NE(error.find("'moon'"), std::string::npos) << error;
  EXPECT_NE(error.find("street, garden, room"), std::string::npos) << error;
}

TEST(Scenes, SeedChangesTheTextures) {
  const StereoFrame a = render(make_scene("room", 1), 0, clean(80, 45));
  const StereoFrame b = render(make_scene("room", 2), 0, clean(80, 45));
  EXPECT_GT(cv::norm(a.left, b.left, cv::NORM_INF), 10);
}

}  // namespace
}  // namespace mtstereo::render::consistency_test
