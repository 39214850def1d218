// SPDX-License-Identifier: LGPL-2.1-or-later
// Ground truth and occlusion of simple scenes, compared with analytical values.
#include <gtest/gtest.h>

#include <cmath>

#include "tools/render/render.hpp"

namespace mtstereo::render::geometry_test {
namespace {

Settings camera(int width, int height) {
  Settings s;
  s.width = width, s.height = height;
  s.focal = 100, s.baseline = 0.1, s.noise = 0, s.samples = 1, s.threads = 1;
  return s;
}

Scene facing_wall(double depth, double half_size = 50) {
  SceneBuilder b("wall", 1);
  b.rectangle({0, 0, depth}, half_size, half_size, Texture());
  return b.scene();
}

TEST(Geometry, FrontoParallelWallHasOneDisparity) {
  const StereoFrame f = render(facing_wall(2.5), 0, camera(41, 31));
  for (int y = 0; y < 31; ++y) {
    for (int x = 0; x < 41; ++x) {
      ASSERT_FLOAT_EQ(f.truth.at<float>(y, x), 4.0f) << "at " << x << ", " << y;
    }
  }
}

TEST(Geometry, SlantedPlaneHasLinearDisparity) {
  // The plane z = 4 + x, hit at x_c = (column - cx) / f: 1/z = (1 - x_c) / 4, d = 10 / z.
  SceneBuilder b("slant", 1);
  b.rectangle({0, 0, 4}, 50, 50, Texture(), -std::atan(1.0));
  const StereoFrame f = render(b.scene(), 0, camera(61, 21));
  for (int x = 0; x < 61; ++x) {
    ASSERT_NEAR(f.truth.at<float>(7, x), 10 * (1 - (x - 30) / 100.0) / 4, 1e-5) << "column " << x;
  }
}

TEST(Geometry, SphereIsNearestAtItsCenter) {
  SceneBuilder b("ball", 1);
  b.sphere({0, 0, 3}, 1, Texture());
  const StereoFrame f = render(b.scene(), 0, camera(101, 101));
  EXPECT_NEAR(f.truth.at<float>(50, 50), 10 / 2.0, 1e-5);
  // On the outline the sine of the angle to the axis is 1/3: 35.4 px from the center.
  EXPECT_TRUE(std::isfinite(f.truth.at<float>(50, 50 + 35)));
  EXPECT_TRUE(std::isinf(f.truth.at<float>(50, 50 + 36)));
}

TEST(Geometry, BoxShowsItsFrontFace) {
  SceneBuilder b("box", 1);
  b.box({0, 0, 3}, {0.5, 0.5, 0.5}, Texture());
  const StereoFrame f = render(b.scene(), 0, camera(101, 101));
  EXPECT_NEAR(f.truth.at<float>(50, 50), 10 / 2.5, 1e-5);
  EXPECT_NEAR(f.truth.at<float>(50 + 19, 50 - 19), 10 / 2.5, 1e-5);  // its edge is at 20 px
  EXPECT_TRUE(std::isinf(f.truth.at<float>(50, 50 + 21)));
}

TEST(Geometry, PoleHasItsWidthAndLength) {
  SceneBuilder b("pole", 1);
  b.pole({0, 0.5, 2}, 1.0, 0.1, Texture());
  const StereoFrame f = render(b.scene(), 0, camera(101, 101));
  EXPECT_NEAR(f.truth.at<float>(50, 50), 10 / 1.9, 1e-5);
  EXPECT_TRUE(std::isfinite(f.truth.at<float>(50, 50 + 5)));
  EXPECT_TRUE(std::isinf(f.truth.at<float>(50, 50 + 6)));
  EXPECT_TRUE(std::isfinite(f.truth.at<float>(50 + 25, 50)));
  EXPECT_TRUE(std::isinf(f.truth.at<float>(50 + 28, 50)));
}

TEST(Geometry, RayThroughAHoleHitsTheObjectBehindIt) {
  SceneBuilder b("fence", 1);
  Object& fence = b.rectangle({0, 0, 2}, 1, 1, Texture());
  fence.cutout = Cutout::kBars, fence.cutout_period = 0.2, fence.cutout_solid = 0.5;
  b.rectangle({0, 0, 5}, 50, 50, Texture());
  const StereoFrame f = render(b.scene(), 0, camera(101, 41));
  // A bar covers 0 to 0.1 m of each 0.2 m, at 50 px per meter: 5 px solid, 5 px open.
  EXPECT_FLOAT_EQ(f.truth.at<float>(20, 52), 5.0f);
  EXPECT_FLOAT_EQ(f.truth.at<float>(20, 57), 2.0f);
  EXPECT_FLOAT_EQ(f.truth.at<float>(20, 62), 5.0f);
}

TEST(Geometry, OccludedBandIsAsWideAsTheStepInDisparity) {
  SceneBuilder b("step", 1);
  b.rectangle({0, 0, 1}, 0.205, 50, Texture());  // disparity 10, columns 50 - 20 to 50 + 20
  b.rectangle({0, 0, 5}, 50, 50, Texture());     // disparity 2
  const StereoFrame f = render(b.scene(), 0, camera(101, 5));
  const auto* hidden = f.occluded.ptr<std::uint8_t>(2);
  for (int x = 0; x < 101; ++x) {
    // Left of the front, 8 px of the wall are hidden from the right camera; at the left border, a
    // disparity of 2 is outside the right image.
    const bool expected = x < 2 || (x >= 22 && x < 30);
    ASSERT_EQ(hidden[x] != 0, expected) << "column " << x;
  }
}

TEST(Geometry, SkyHasNoTruthAndIsNotOccluded) {
  const StereoFrame f = render(Scene(), 0, camera(9, 9));
  EXPECT_TRUE(std::isinf(f.truth.at<float>(0, 0)));
  EXPECT_EQ(f.occluded.at<std::uint8_t>(0, 0), 0);
}

TEST(Geometry, ObjectsBehindTheCameraAreInvisible) {
  const StereoFrame f = render(facing_wall(-2), 0, camera(9, 9));
  EXPECT_TRUE(std::isinf(f.truth.at<float>(4, 4)));
}

TEST(Geometry, CameraAndObjectsMove) {
  Scene scene = facing_wall(4);
  scene.camera.velocity = {0, 0, 1};
  scene.objects[0].motion.velocity = {0, 0, -1};
  EXPECT_FLOAT_EQ(render(scene, 0, camera(3, 3)).truth.at<float>(1, 1), 2.5f);
  EXPECT_FLOAT_EQ(render(scene, 1, camera(3, 3)).truth.at<float>(1, 1), 5.0f);
}

TEST(Geometry, DefaultsComeFromTheScene) {
  Scene scene = facing_wall(4);
  scene.baseline = 0.25, scene.focal_per_width = 2;
  Settings s = camera(50, 3);
  s.focal = s.baseline = 0;
  EXPECT_DOUBLE_EQ(complete(scene, s).focal, 100);
  EXPECT_FLOAT_EQ(render(scene, 0, s).truth.at<float>(1, 1), 6.25f);
}

}  // namespace
}  // namespace mtstereo::render::geometry_test
