// SPDX-License-Identifier: LGPL-2.1-or-later
#include <utility>

#include "tools/render/scene.hpp"

namespace mtstereo::render {
namespace {

using Eigen::Vector3d;

constexpr double kFloor = 1.1;  // the camera's height above the floor [m]

// Painted plaster: almost no texture, like real walls.
Texture plaster(double mean) {
  Texture t;
  t.mean = mean, t.noise_contrast = 0.025, t.noise_size = 0.8, t.octaves = 7, t.persistence = 0.85;
  t.color = {0.93f, 0.98f, 1.0f};
  return t;
}

Texture parquet() {
  Texture t;
  t.pattern = Pattern::kPlanks;
  t.mean = 0.5, t.noise_contrast = 0.12, t.noise_size = 0.25, t.octaves = 7, t.persistence = 0.85;
  t.pattern_contrast = 0.2, t.period_u = 0.14;
  t.color = {0.6f, 0.8f, 1.0f};
  return t;
}

Texture fabric(double mean, const Eigen::Vector3f& color) {
  Texture t;
  t.mean = mean, t.noise_contrast = 0.15, t.noise_size = 0.1, t.octaves = 6, t.persistence = 0.9;
  t.color = color;
  return t;
}

Texture painting() {
  Texture t;
  t.mean = 0.5, t.noise_contrast = 0.5, t.noise_size = 0.3, t.octaves = 6, t.persistence = 0.65;
  t.color = {1.0f, 0.85f, 0.7f};
  return t;
}

Texture chequers() {
  Texture t = fabric(0.5, {1, 1, 1});
  t.pattern = Pattern::kTiles, t.pattern_contrast = 0.5, t.period_u = 0.09, t.period_v = 0.09;
  return t;
}

void table(SceneBuilder& b, const Vector3d& foot, double half_width, double half_depth) {
  const Texture wood = parquet();
  b.box(foot - Vector3d(0, 0.74, 0), {half_width, 0.02, half_depth}, wood);
  for (const double x : {-1.0, 1.0}) {
    for (const double z : {-1.0, 1.0}) {
      b.pole(foot + Vector3d(x * (half_width - 0.05), 0, z * (half_depth - 0.05)), 0.72, 0.022,
             fabric(0.3, {1, 1, 1}));
    }
  }
}

void shelf(SceneBuilder& b, const Vector3d& foot, double half_width) {
  b.box(foot + Vector3d(0, -0.9, 0.16), {half_width, 0.9, 0.01}, parquet());
  for (int board = 0; board < 5; ++board) {
    const double y = -0.04 - 0.42 * board;
    b.box(foot + Vector3d(0, y, 0), {half_width, 0.015, 0.15}, parquet());
    if (board == 4) break;
    for (double x = -half_width + 0.03; x < half_width - 0.03;) {
      const double thick = b.random(0.018, 0.05), height = b.random(0.2, 0.34);
      const Eigen::Vector3f cover(static_cast<float>(b.random(0.4, 1)),
                                  static_cast<float>(b.random(0.4, 1)),
                                  static_cast<float>(b.random(0.4, 1)));
      if (b.random(0, 1) < 0.85) {
        b.box(foot + Vector3d(x + thick / 2, y - 0.015 - height / 2, b.random(-0.06, 0.03)),
              {thick / 2, height / 2, 0.09}, fabric(b.random(0.25, 0.8), cover));
      }
      x += thick + 0.002;
    }
  }
}

void walls(SceneBuilder& b) {
  b.ground(kFloor, 4, -1, 5, parquet());
  b.ground(kFloor - 2.6, 4, -1, 5, plaster(0.85));
  b.rectangle({0, kFloor - 1.3, 4.6}, 3.2, 1.3, plaster(0.7));
  b.rectangle({-2.3, kFloor - 1.3, 2}, 3, 1.3, plaster(0.62), kQuarterTurn);
  b.rectangle({2.5, kFloor - 1.3, 2}, 3, 1.3, plaster(0.66), kQuarterTurn);
  b.rectangle({0.95, kFloor - 1.6, 4.57}, 0.55, 0.4, painting());
  b.rectangle({-2.27, kFloor - 1.5, 2.9}, 0.5, 0.4, painting(), kQuarterTurn);
}

}  // namespace

Scene make_room(std::uint32_t seed) {
  SceneBuilder b("room", seed);
  Scene& scene = b.scene();
  scene.baseline = 0.1;
  scene.to_light = {0.3, -0.8, -0.6};
  scene.camera.velocity = {0.06, 0, 0.12};
  scene.camera.swing = {0.03, 0.01, 0};
  scene.camera.yaw_swing = 0.03;
  scene.camera.pitch = 0.1;

  walls(b);
  table(b, {0.35, kFloor, 2.5}, 0.55, 0.35);
  b.box({0.15, kFloor - 0.86, 2.45}, {0.11, 0.1, 0.08}, chequers(), 0.5);
  b.pole({0.65, kFloor - 0.76, 2.5}, 0.24, 0.04, painting());
  b.sphere({0.4, kFloor - 0.83, 2.3}, 0.07, fabric(0.55, {0.4f, 0.6f, 1.0f}));
  shelf(b, {-0.95, kFloor, 4.2}, 0.6);

  // A sofa, a board leaning against it, a wire fire guard and a lamp on a thin stand.
  b.box({-1.55, kFloor - 0.25, 2.6}, {0.35, 0.25, 0.6}, fabric(0.4, {1.0f, 0.7f, 0.6f}), 0.2);
  b.box({-1.85, kFloor - 0.6, 2.6}, {0.1, 0.35, 0.6}, fabric(0.4, {1.0f, 0.7f, 0.6f}), 0.2);
  b.rectangle({-0.75, kFloor - 0.4, 2.2}, 0.2, 0.42, chequers(), -0.4, 0.35);
  Object& guard = b.rectangle({1.55, kFloor - 0.4, 2.7}, 0.4, 0.4, fabric(0.25, {1, 1, 1}), -0.4);
  guard.cutout = Cutout::kMesh;
  guard.cutout_period = 0.08, guard.cutout_solid = 0.18;
  b.pole({1.9, kFloor, 3.6}, 1.6, 0.012, fabric(0.3, {1, 1, 1}));
  b.pole({1.9, kFloor - 1.6, 3.6}, 0.3, 0.2, fabric(0.8, {0.8f, 0.95f, 1.0f}));

  Object& ball = b.sphere({-0.15, kFloor - 1.35, 1.7}, 0.12, chequers());
  ball.motion.swing = {0.25, 0.03, 0.1};
  ball.motion.swing_rate = 0.6;
  ball.motion.spin = 2;
  b.box({0.9, kFloor - 0.2, 1.9}, {0.16, 0.2, 0.16}, painting(), 0.7).motion.spin = 0.5;
  return std::move(scene);
}

}  // namespace mtstereo::render
