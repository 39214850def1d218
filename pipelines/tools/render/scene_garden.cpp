// SPDX-License-Identifier: LGPL-2.1-or-later
#include <utility>

#include "tools/render/scene.hpp"

namespace mtstereo::render {
namespace {

using Eigen::Vector3d;

constexpr double kLawn = 0.4;  // the camera's height above the lawn [m]

Texture lawn() {
  Texture t;
  t.mean = 0.45, t.noise_contrast = 0.16, t.noise_size = 0.5, t.octaves = 9, t.persistence = 0.92;
  t.color = {0.5f, 1.0f, 0.65f};
  return t;
}

Texture gravel() {
  Texture t;
  t.mean = 0.6, t.noise_contrast = 0.1, t.noise_size = 0.1, t.octaves = 6, t.persistence = 1.0;
  t.color = {0.85f, 0.95f, 1.0f};
  return t;
}

Texture hedge() {
  Texture t;
  t.mean = 0.32, t.noise_contrast = 0.22, t.noise_size = 0.2, t.octaves = 7, t.persistence = 0.9;
  t.color = {0.4f, 0.9f, 0.5f};
  return t;
}

Texture wood(double mean) {
  Texture t;
  t.pattern = Pattern::kPlanks;
  t.mean = mean, t.noise_contrast = 0.2, t.noise_size = 0.12, t.octaves = 5, t.persistence = 0.8;
  t.pattern_contrast = 0.15, t.period_u = 0.12;
  t.color = {0.65f, 0.82f, 1.0f};
  return t;
}

Texture stone() {
  Texture t;
  t.pattern = Pattern::kBricks;
  t.mean = 0.5, t.noise_contrast = 0.25, t.noise_size = 0.3, t.octaves = 7, t.persistence = 0.8;
  t.pattern_contrast = 0.3, t.period_u = 0.3, t.period_v = 0.12;
  t.color = {0.7f, 0.78f, 1.0f};
  return t;
}

Texture flower(const Eigen::Vector3f& color) {
  Texture t;
  t.mean = 0.7, t.noise_contrast = 0.2, t.noise_size = 0.03, t.octaves = 3;
  t.color = color;
  return t;
}

// A trimmed bush: a dark core with protruding leaves.
void bush(SceneBuilder& b, const Vector3d& center, double radius) {
  b.sphere(center, 0.86 * radius, hedge());
  Texture leaf = hedge();
  leaf.mean = 0.5, leaf.octaves = 4, leaf.noise_size = 0.03;
  b.foliage(center, radius, 150, 0.05, leaf);
}

void pot(SceneBuilder& b, const Vector3d& foot, double height) {
  Texture clay = stone();
  clay.pattern = Pattern::kPlain, clay.color = {0.45f, 0.6f, 1.0f};
  b.pole(foot, height, 0.6 * height, clay);
  bush(b, foot - Vector3d(0, 1.5 * height, 0), 0.75 * height);
}

// Thin stems with one blossom each, moving in the wind.
void flowers(SceneBuilder& b, const Vector3d& foot, int count, const Eigen::Vector3f& color) {
  for (int i = 0; i < count; ++i) {
    const Vector3d at = foot + Vector3d(b.random(-0.25, 0.25), 0, b.random(-0.25, 0.25));
    const double height = b.random(0.2, 0.42);
    const double phase = b.random(0, 1);
    Texture green = flower({0.4f, 0.9f, 0.5f});
    green.mean = 0.4;
    Object& stem = b.pole(at, height, 0.006, green);
    stem.motion.swing = {0.008, 0, 0}, stem.motion.swing_rate = 0.9,
    stem.motion.swing_phase = phase;
    const Motion wind = stem.motion;
    b.sphere(at - Vector3d(0, height, 0), 0.028, flower(color)).motion = wind;
  }
}

}  // namespace

Scene make_garden(std::uint32_t seed) {
  SceneBuilder b("garden", seed);
  Scene& scene = b.scene();
  scene.baseline = 0.06;
  scene.camera.velocity = {0.03, 0, 0.18};
  scene.camera.swing = {0, 0.006, 0};
  scene.camera.swing_rate = 1.5;
  scene.camera.yaw_swing = 0.015;
  scene.camera.pitch = 0.06;

  b.ground(kLawn, 12, -1, 16, lawn());
  Object& path = b.rectangle({-0.7, kLawn - 0.004, 4}, 0.35, 5, gravel(), 0, kQuarterTurn);
  path.pose.rotate(Eigen::AngleAxisd(-0.12, Vector3d::UnitZ()));
  b.box({-2.6, kLawn - 0.4, 4.5}, {0.35, 0.4, 3}, hedge(), 0.15);
  b.box({0, kLawn - 0.9, 9.5}, {9, 0.9, 0.2}, stone(), -0.1);
  b.box({2.6, kLawn - 0.6, 6.0}, {0.9, 0.6, 0.5}, wood(0.5), 0.5);

  bush(b, {-1.15, kLawn - 0.34, 2.5}, 0.34);
  bush(b, {0.35, kLawn - 0.26, 3.4}, 0.27);
  bush(b, {1.5, kLawn - 0.4, 4.4}, 0.42);
  bush(b, {-0.6, kLawn - 0.45, 5.8}, 0.45);
  pot(b, {0.85, kLawn, 1.75}, 0.2);
  flowers(b, {-0.45, kLawn, 1.35}, 6, {0.5f, 0.5f, 1.0f});
  flowers(b, {0.5, kLawn, 2.3}, 7, {0.5f, 0.95f, 1.0f});

  Object& fence = b.rectangle({1.45, kLawn - 0.35, 2.6}, 0.9, 0.35, wood(0.7), -0.55);
  fence.cutout = Cutout::kBars;
  fence.cutout_period = 0.12, fence.cutout_solid = 0.45;
  for (int i = 0; i < 26; ++i) {
    const double radius = b.random(0.012, 0.04);
    b.sphere({b.random(-1.6, 1.4), kLawn - 0.5 * radius, b.random(1.1, 3.5)}, radius, gravel());
  }
  Object& ball = b.sphere({-0.1, kLawn - 0.11, 2.0}, 0.11, flower({0.4f, 0.4f, 1.0f}));
  ball.motion.velocity = {0.12, 0, 0.1};
  ball.motion.spin = 1;
  return std::move(scene);
}

}  // namespace mtstereo::render
