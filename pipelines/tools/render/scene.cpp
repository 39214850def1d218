// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/render/scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace mtstereo::render {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

Eigen::Isometry3d CameraPath::pose_at(double time) const {
  const double phase = std::sin(2 * std::numbers::pi * swing_rate * time);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translate(position + velocity * time + swing * phase);
  pose.rotate(AngleAxisd(yaw + yaw_swing * phase, Vector3d::UnitY()));
  pose.rotate(AngleAxisd(-pitch, Vector3d::UnitX()));
  return pose;
}

const std::vector<std::string>& scene_names() {
  static const std::vector<std::string> names = {"street", "garden", "room"};
  return names;
}

Scene make_scene(std::string_view name, std::uint32_t seed) {
  if (name == "street") return make_street(seed);
  if (name == "garden") return make_garden(seed);
  if (name == "room") return make_room(seed);
  std::string known;
  for (const auto& n : scene_names()) known += (known.empty() ? "" : ", ") + n;
  throw std::invalid_argument("there is no scene '" + std::string(name) + "'; the scenes are " +
                              known);
}

SceneBuilder::SceneBuilder(std::string name, std::uint32_t seed) : seed_(seed) {
  scene_.name = std::move(name);
}

double SceneBuilder::random(double low, double high) {
  return low + (high - low) * hash_unit(seed_, ++drawn_, 0x5eedu);
}

Object& SceneBuilder::add(Shape shape, const Vector3d& center, const Vector3d& size,
                          const Texture& texture) {
  Object object;
  object.shape = shape;
  object.size = size;
  object.pose.pretranslate(center);
  object.texture = texture;
  object.texture.seed = hash(seed_, static_cast<std::uint32_t>(scene_.objects.size()), 0x7e87u);
  return scene_.objects.emplace_back(std::move(object));
}

Object& SceneBuilder::rectangle(const Vector3d& center, double half_width, double half_height,
                                const Texture& texture, double yaw, double pitch) {
  Object& o = add(Shape::kRectangle, center, {half_width, half_height, 0}, texture);
  o.pose.rotate(AngleAxisd(yaw, Vector3d::UnitY()));
  o.pose.rotate(AngleAxisd(pitch, Vector3d::UnitX()));
  return o;
}

Object& SceneBuilder::box(const Vector3d& center, const Vector3d& half_size, const Texture& texture,
                          double yaw) {
  Object& o = add(Shape::kBox, center, half_size, texture);
  o.pose.rotate(AngleAxisd(yaw, Vector3d::UnitY()));
  return o;
}

Object& SceneBuilder::sphere(const Vector3d& center, double radius, const Texture& texture) {
  return add(Shape::kSphere, center, Vector3d::Constant(radius), texture);
}

Object& SceneBuilder::pole(const Vector3d& foot, double height, double radius,
                           const Texture& texture) {
  return add(Shape::kCylinder, foot - Vector3d(0, height / 2, 0), {radius, height / 2, radius},
             texture);
}

Object& SceneBuilder::ground(double y, double half_width, double from, double to,
                             const Texture& texture) {
  return rectangle({0, y, (from + to) / 2}, half_width, (to - from) / 2, texture, 0, kQuarterTurn);
}

void SceneBuilder::foliage(const Vector3d& center, double radius, int leaves, double leaf_size,
                           const Texture& texture) {
  for (int i = 0; i < leaves; ++i) {
    // Uniform in the ball: height and angle on the sphere, cube root along the radius.
    const double height = random(-1, 1), around = random(0, 2 * std::numbers::pi);
    const double ring = std::sqrt(1 - height * height), out = radius * std::cbrt(random(0.2, 1));
    const Vector3d at =
        center + out * Vector3d(ring * std::cos(around), height, ring * std::sin(around));
    Texture own = texture;
    own.mean += random(-0.16, 0.16);
    Object& leaf = rectangle(at, leaf_size * random(0.7, 1.2), leaf_size * random(0.35, 0.55), own,
                             random(-0.9, 0.9), random(-0.9, 0.9));
    leaf.pose.rotate(AngleAxisd(random(0, std::numbers::pi), Vector3d::UnitZ()));
    leaf.cutout = Cutout::kLeaf;
    leaf.motion.swing = {0.1 * leaf_size, 0.05 * leaf_size, 0};
    leaf.motion.swing_rate = 0.8;
    leaf.motion.swing_phase = random(0, 1);
  }
}

}  // namespace mtstereo::render
