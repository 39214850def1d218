// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/prepare/camera_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/plane.hpp"
#include "support/random.hpp"

namespace mtstereo::camera_motion_test {
namespace {

/// An image that is defined between its pixels too: waves of 15 to 500 px, as coarse and fine
/// parts of a scene.
class Texture {
 public:
  explicit Texture(std::uint64_t seed) {
    Random random(seed);
    double frequency = 0.42;
    for (Wave& wave : waves_) {
      const double angle = random.between(0, 628) / 100.0;
      wave = {static_cast<float>(frequency * std::cos(angle)),
              static_cast<float>(frequency * std::sin(angle)), random.between(0, 628) / 100.0F};
      frequency *= 0.75;
    }
  }
  double at(float x, float y) const {
    float sum = 128;
    for (const Wave& wave : waves_) sum += 11 * std::sin(wave.x * x + wave.y * y + wave.phase);
    return sum;
  }

 private:
  struct Wave {
    float x, y, phase;
  };
  std::array<Wave, 13> waves_;
};

/// A slanted surface with a nearer box before it [px].
double disparity_at(int x, int y, int width, int height) {
  const bool box = x > width / 3 && x < width / 2 && y > height / 4;
  return box ? 30 : 8 + 8.0 * y / height;
}

/// What two pairs see.
struct Scene {
  int width, height;
  GrayPlane now, last;
  DisparityPlane map;
};

/// Two views of a texture: `was` is where the points of the present one were.
Scene scene_of(int width, int height, const CameraMotion& was, double noise = 0, double gain = 1) {
  Scene scene{width, height, {width, height}, {width, height}, {width, height}};
  const Texture texture(3);
  Random random(4);
  const auto gray = [&](double value) {
    const double error = noise * (random.between(-1000, 1000) + random.between(-1000, 1000)) / 816;
    return static_cast<std::uint8_t>(std::clamp(std::lround(value + error), 0L, 255L));
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double disparity = disparity_at(x, y, width, height);
      const ScenePoint last =
          was.moved({static_cast<float>(x - width / 2.0), static_cast<float>(y - height / 2.0),
                     static_cast<float>(disparity)});
      scene.now(x, y) = gray(gain * texture.at(last.x, last.y));
      scene.last(x, y) = gray(texture.at(x - width / 2.0F, y - height / 2.0F));
      scene.map(x, y) = static_cast<int>(std::lround(disparity * kDisparityOne));
    }
  }
  return scene;
}

ViewPyramid pyramid_of(const GrayPlane& plane) {
  ViewPyramid pyramid;
  pyramid.resize(plane.width, plane.height);
  GrayView view = plane.view();
  for (int i = 0; i < pyramid.count; ++i) {
    halve_rows(view, 0, pyramid.levels[i].height(), pyramid.levels[i]);
    view = pyramid.levels[i].view();
  }
  return pyramid;
}

std::optional<CameraMotion> found(const Scene& scene, float offset = 0, int confidence = 200) {
  const ViewPyramid now = pyramid_of(scene.now), last = pyramid_of(scene.last);
  DisparityPlane map = scene.map;
  for (int& disparity : map.pixels) disparity -= static_cast<int>(offset * kDisparityOne);
  MotionPoints points;
  points.resize(scene.width, scene.height);
  if (now.count > 0) {
    const GrayPlane rating(scene.width, scene.height, static_cast<std::uint8_t>(confidence));
    for (int row = 0; row < points.rows; ++row) {
      choose_points(now.levels[0], image_of(map), image_of(rating), offset, row, row + 1, points);
    }
  }
  return find_motion(points, now, last, scene.width, scene.height);
}

/// The largest error of the place of a pixel [px].
double error(const Scene& scene, const CameraMotion& expected, const CameraMotion& motion) {
  double most = 0;
  for (int y = 0; y < scene.height; ++y) {
    for (int x = 0; x < scene.width; ++x) {
      const ScenePoint now = {static_cast<float>(x - scene.width / 2.0),
                              static_cast<float>(y - scene.height / 2.0),
                              static_cast<float>(scene.map(x, y)) / kDisparityOne};
      const ScenePoint a = expected.moved(now), b = motion.moved(now);
      most = std::max<double>(
          {most, std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.disparity - b.disparity)});
    }
  }
  return most;
}

constexpr CameraMotion kStill;
constexpr CameraMotion kSideways = {.shift_x = 0.5F, .parallax_x = 0.4F};
constexpr CameraMotion kForward = {.shift_y = 0.3F, .approach = -2e-3F};
constexpr CameraMotion kTurning = {
    .shift_x = 9, .shift_y = -4, .roll = 0.02F, .turn_x = 4e-5F, .turn_y = -3e-5F};
constexpr CameraMotion kAll = {.shift_x = -6,
                               .shift_y = 2,
                               .roll = -0.01F,
                               .parallax_x = -0.2F,
                               .parallax_y = 0.05F,
                               .approach = 1e-3F,
                               .turn_x = -2e-5F,
                               .turn_y = 1e-5F};

TEST(CameraMotion, FindsTheMotionOfViewsOfAnySize) {
  for (const CameraMotion& motion : {kStill, kSideways, kForward, kTurning, kAll}) {
    for (const auto& [width, height] : {std::pair(320, 240), {641, 363}, {203, 151}}) {
      const Scene scene = scene_of(width, height, motion);
      const std::optional<CameraMotion> was = found(scene);
      ASSERT_TRUE(was) << width;
      EXPECT_LT(error(scene, motion, *was), 0.25) << width << ", " << motion.approach;
    }
  }
}

TEST(CameraMotion, WithstandsNoiseAndOtherExposure) {
  for (const CameraMotion& motion : {kStill, kForward, kAll}) {
    const Scene noisy = scene_of(640, 480, motion, 10), bright = scene_of(640, 480, motion, 1, 1.1);
    for (const Scene& scene : {noisy, bright}) {
      const std::optional<CameraMotion> was = found(scene);
      ASSERT_TRUE(was);
      EXPECT_LT(error(scene, motion, *was), 0.7) << motion.approach;
    }
  }
}

TEST(CameraMotion, KnowsDisparitiesThatDoNotBeginAtZero) {
  const Scene scene = scene_of(640, 480, kForward);
  for (const float offset : {-20.0F, 5.5F}) {
    const std::optional<CameraMotion> was = found(scene, offset);
    ASSERT_TRUE(was);
    EXPECT_LT(error(scene, kForward, *was), 0.25) << offset;
  }
}

TEST(CameraMotion, IsUnknownBetweenDifferentScenes) {
  Scene scene = scene_of(640, 480, kStill);
  const Texture other(8);
  for (int y = 0; y < scene.height; ++y) {
    for (int x = 0; x < scene.width; ++x) {
      scene.last(x, y) = static_cast<std::uint8_t>(
          std::clamp(other.at(static_cast<float>(x), static_cast<float>(y)), 0.0, 255.0));
    }
  }
  EXPECT_FALSE(found(scene));
  scene.last = test::noise(640, 480, 9);
  EXPECT_FALSE(found(scene));
  scene.last = scene.now;
  EXPECT_TRUE(found(scene));
}

TEST(CameraMotion, IsUnknownIfNothingCanBeCompared) {
  Scene scene = scene_of(320, 240, kStill);
  EXPECT_FALSE(found(scene, 0, kMostInferred)) << "nothing is matched";
  scene.now = scene.last = GrayPlane(320, 240, 90);
  EXPECT_FALSE(found(scene)) << "nothing has an edge";
}

TEST(CameraMotion, AcceptsSmallViews) {
  for (int width = 1; width < 60; ++width) {
    for (const int height : {1, 2, 11, 23, 24, 37, 59}) {
      const Scene scene = scene_of(width, height, kStill);
      const std::optional<CameraMotion> was = found(scene);
      if (!was) continue;
      EXPECT_LT(error(scene, kStill, *was), 0.5) << width << 'x' << height;
    }
  }
}

}  // namespace
}  // namespace mtstereo::camera_motion_test
