// SPDX-License-Identifier: LGPL-2.1-or-later
#include <utility>
#include <vector>

#include "tools/render/scene.hpp"

namespace mtstereo::render {
namespace {

using Eigen::Vector3d;

constexpr double kGround = 1.4;  // the camera's height above the road [m]

Texture asphalt() {
  Texture t;
  t.pattern = Pattern::kLines;
  t.mean = 0.36, t.noise_contrast = 0.09, t.noise_size = 0.9, t.octaves = 8, t.persistence = 0.85;
  t.pattern_contrast = 0.5, t.period_u = 3.4, t.period_v = 4;
  t.color = {1.0f, 0.98f, 0.97f};
  return t;
}

Texture pavement() {
  Texture t;
  t.pattern = Pattern::kTiles;
  t.mean = 0.6, t.noise_contrast = 0.12, t.noise_size = 0.6, t.octaves = 7, t.persistence = 0.8;
  t.pattern_contrast = 0.1, t.period_u = 0.4, t.period_v = 0.4;
  return t;
}

Texture facade(SceneBuilder& b) {
  Texture t;
  t.pattern = b.random(0, 1) < 0.7 ? Pattern::kBricks : Pattern::kPlain;
  t.mean = b.random(0.4, 0.75), t.noise_contrast = b.random(0.1, 0.3);
  t.noise_size = b.random(0.5, 1.5), t.octaves = 7, t.persistence = 0.75;
  t.pattern_contrast = b.random(0.15, 0.35), t.period_u = 0.5, t.period_v = 0.18;
  const auto warm = static_cast<float>(b.random(0.6, 1));
  t.color = {0.75f * warm + 0.1f, 0.85f * warm + 0.05f, 1.0f};
  return t;
}

Texture paint(double mean, const Eigen::Vector3f& color) {
  Texture t;
  t.mean = mean, t.noise_contrast = 0.12, t.noise_size = 0.4, t.octaves = 6, t.persistence = 0.8;
  t.color = color;
  return t;
}

Texture leaves() {
  Texture t;
  t.mean = 0.5, t.noise_contrast = 0.2, t.noise_size = 0.08, t.octaves = 3;
  t.color = {0.45f, 0.95f, 0.6f};
  return t;
}

// Houses on one side of the road (-1 left, 1 right), with windows in the walls.
void houses(SceneBuilder& b, double side) {
  const Texture glass = paint(0.22, {1.0f, 0.92f, 0.85f});
  for (double z = -4; z < 85;) {
    const double depth = b.random(6, 11), height = b.random(5, 9), front = b.random(6.2, 7.4);
    b.box({side * (front + 3), kGround - height / 2, z + depth / 2}, {3, height / 2, depth / 2},
          facade(b));
    for (double floor = 1.6; floor < height - 1; floor += 2.6) {
      for (double along = 1.5; along < depth - 1; along += 2.4) {
        b.rectangle({side * (front - 0.04), kGround - floor - 0.3, z + along}, 0.5, 0.7, glass,
                    side * kQuarterTurn);
      }
    }
    z += depth + (b.random(0, 1) < 0.3 ? 1.5 : 0);
  }
}

void car(SceneBuilder& b, const Vector3d& at, const Eigen::Vector3f& color,
         const Vector3d& velocity) {
  const auto moving = [&velocity](Object& o) { o.motion.velocity = velocity; };
  moving(b.box(at + Vector3d(0, -0.65, 0), {0.85, 0.32, 2.0}, paint(0.6, color)));
  moving(b.box(at + Vector3d(0, -1.2, 0.2), {0.72, 0.27, 1.1}, paint(0.3, {1, 1, 1})));
  for (const double x : {-0.75, 0.75}) {
    for (const double z : {-1.3, 1.3}) {
      moving(b.sphere(at + Vector3d(x, -0.31, z), 0.31, paint(0.15, {1, 1, 1})));
    }
  }
}

void tree(SceneBuilder& b, const Vector3d& foot) {
  Texture bark = paint(0.35, {0.75f, 0.88f, 1.0f});
  bark.noise_contrast = 0.35, bark.noise_size = 0.15;
  b.pole(foot, 2.4, 0.13, bark);
  b.foliage(foot + Vector3d(0, -3.0, 0), 1.2, 260, 0.16, leaves());
}

void walker(SceneBuilder& b, const Vector3d& foot, const Vector3d& velocity,
            const Eigen::Vector3f& coat) {
  Object& body = b.box(foot + Vector3d(0, -1.05, 0), {0.22, 0.42, 0.14}, paint(0.5, coat));
  Object& head = b.sphere(foot + Vector3d(0, -1.62, 0), 0.13, paint(0.6, {0.7f, 0.82f, 1.0f}));
  body.motion.velocity = head.motion.velocity = velocity;
  for (const double x : {-0.11, 0.11}) {
    Object& leg = b.pole(foot + Vector3d(x, 0, 0), 0.65, 0.08, paint(0.25, {1, 0.9f, 0.85f}));
    leg.motion.velocity = velocity;
    leg.motion.swing = {0, 0, x * 1.8};
    leg.motion.swing_rate = 1;
  }
}

}  // namespace

Scene make_street(std::uint32_t seed) {
  SceneBuilder b("street", seed);
  Scene& scene = b.scene();
  scene.baseline = 0.3;
  scene.camera.velocity = {0, 0, 3};
  scene.camera.swing = {0.05, 0.015, 0};
  scene.camera.swing_rate = 0.7;
  scene.camera.yaw_swing = 0.02;

  b.ground(kGround, 40, -10, 160, asphalt());
  for (const double side : {-1.0, 1.0}) {
    b.box({side * 5.5, kGround - 0.07, 60}, {1.7, 0.07, 70}, pavement());
    houses(b, side);
    for (double z = b.random(4, 7); z < 60; z += 9) {
      b.pole({side * 4.1, kGround, z}, 4.5, 0.055, paint(0.3, {1, 1, 1}));
    }
  }
  b.box({0, kGround - 5, 95}, {9, 5, 2}, facade(b));

  car(b, {-2.9, kGround, 12}, {0.35f, 0.35f, 1.0f}, Vector3d::Zero());
  car(b, {-2.9, kGround, 19}, {1.0f, 0.8f, 0.5f}, Vector3d::Zero());
  car(b, {2.9, kGround, 14}, {0.95f, 0.95f, 0.95f}, Vector3d::Zero());
  car(b, {1.2, kGround, 34}, {0.5f, 0.9f, 0.9f}, {0, 0, -4});
  tree(b, {-4.6, kGround, 8.5});
  tree(b, {4.7, kGround, 11});
  tree(b, {4.6, kGround, 24});
  walker(b, {-1.7, kGround, 14.6}, {0.8, 0, 0}, {1.0f, 0.5f, 0.4f});
  walker(b, {4.9, kGround, 7.5}, {0, 0, 1.2}, {0.4f, 0.6f, 1.0f});

  Object& fence = b.rectangle({3.9, kGround - 0.55, 8.2}, 1.6, 0.55, paint(0.8, {1, 1, 1}), 0.9);
  fence.cutout = Cutout::kBars;
  fence.cutout_period = 0.22, fence.cutout_solid = 0.3;
  return std::move(scene);
}

}  // namespace mtstereo::render
