// SPDX-License-Identifier: LGPL-2.1-or-later
// The sky, the sun, lamps and their reflections.
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <string>

#include "tools/render/render.hpp"

namespace mtstereo::render::lights_test {
namespace {

Settings camera(int width = 101, int height = 101) {
  Settings s;
  s.width = width, s.height = height, s.noise = 0;
  s.focal = 100, s.baseline = 0.1, s.samples = 1;
  return s;
}

Scene empty() { return SceneBuilder("empty", 1).scene(); }

int white(const cv::Mat& image) { return cv::countNonZero(image == 255); }

TEST(Sky, FlatSkyHasOneGrayValueAndNoTruth) {
  Settings s = camera();
  s.sky = 0.8, s.sky_gradient = 0;
  const StereoFrame f = render(empty(), 0, s);
  EXPECT_EQ(cv::countNonZero(f.left == f.left.at<std::uint8_t>(0, 0)), 101 * 101);
  EXPECT_TRUE(std::isinf(f.truth.at<float>(50, 50)));
  EXPECT_EQ(f.occluded.at<std::uint8_t>(50, 50), 0);
}

TEST(Sky, BrightSkySaturatesAndLessLightBringsTheGradientBack) {
  Settings s = camera();
  s.sky = 2, s.sky_gradient = 0.5;
  EXPECT_EQ(white(render(empty(), 0, s).right), 101 * 101);
  s.light = 0.4;
  const StereoFrame f = render(empty(), 0, s);
  EXPECT_EQ(white(f.right), 0);
  EXPECT_LT(f.right.at<std::uint8_t>(0, 50), f.right.at<std::uint8_t>(100, 50));
}

TEST(Sky, StaysInPlaceWhenTheRightCameraPitches) {
  Settings s = camera();
  const int aligned = render(empty(), 0, s).right.at<std::uint8_t>(50, 50);
  s.rig.pitch = -10;
  EXPECT_LT(render(empty(), 0, s).right.at<std::uint8_t>(50, 50), aligned);
}

TEST(Sun, IsADiscAtInfinity) {
  Scene scene = empty();
  scene.sun = {{0.2, -0.1, 1}, 0.03, 40};
  const StereoFrame f = render(scene, 0, camera());
  EXPECT_EQ(f.left.at<std::uint8_t>(40, 70), 255);
  EXPECT_LT(f.left.at<std::uint8_t>(40, 5), 255);
  EXPECT_EQ(cv::norm(f.left, f.right, cv::NORM_INF), 0);
  EXPECT_TRUE(std::isinf(f.truth.at<float>(40, 70)));
}

TEST(Lamp, GlowsWithItsOwnDisparity) {
  SceneBuilder b("lamp", 1);
  b.lamp({0, 0, 2}, 0.1, 5);
  const StereoFrame f = render(b.scene(), 0, camera());
  EXPECT_EQ(f.left.at<std::uint8_t>(50, 50), 255);
  EXPECT_NEAR(f.truth.at<float>(50, 50), 10 / 1.9, 1e-4);
}

TEST(Lamp, IsReflectedByWetGroundOnly) {
  const auto rendered = [](double wet) {
    SceneBuilder b("wet", 1);
    Texture dark;
    dark.mean = 0.1, dark.noise_contrast = 0;
    b.ground(1, 20, 1, 40, dark).wet = wet;
    b.lamp({0, -0.2, 6}, 0.05, 10);
    return render(b.scene(), 0, camera());
  };
  const StereoFrame dry = rendered(0), wet = rendered(0.5);
  // The mirror image of the lamp is 2.2 m below the cameras: row 50 + 100 * 2.2 / 6.
  EXPECT_LT(dry.left.at<std::uint8_t>(87, 50), 64);
  EXPECT_EQ(wet.left.at<std::uint8_t>(87, 50), 255);
  // It has the lamp's disparity, 10 / 6 px; the truth is that of the ground.
  EXPECT_EQ(wet.right.at<std::uint8_t>(87, 48), 255);
  EXPECT_NEAR(wet.truth.at<float>(87, 50), 10 / (100.0 / 37), 1e-3);
}

class LitScene : public ::testing::TestWithParam<const char*> {};

TEST_P(LitScene, HasSaturatedAreas) {
  Settings s = camera(160, 90);
  s.focal = 0;
  const StereoFrame plain = render(make_scene(GetParam(), 1), 0.5, s);
  const StereoFrame lit = render(make_scene(GetParam(), 1, true), 0.5, s);
  EXPECT_GT(white(lit.left), white(plain.left) + 20);
  EXPECT_GT(white(lit.right), white(plain.right) + 20);
}

TEST_P(LitScene, LightsMoveNothingElse) {
  Settings s = camera(160, 90);
  s.focal = 0;
  const StereoFrame plain = render(make_scene(GetParam(), 2), 0.5, s);
  const StereoFrame lit = render(make_scene(GetParam(), 2, true), 0.5, s);
  const int changed = cv::countNonZero(plain.truth != lit.truth);  // lamps, window
  EXPECT_LT(changed, plain.truth.rows * plain.truth.cols / 30);
}

INSTANTIATE_TEST_SUITE_P(All, LitScene, ::testing::Values("street", "garden", "room"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace mtstereo::render::lights_test
