// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "render/shapes.hpp"

namespace mtstereo::render {

/// How the left camera moves. World and camera axes: x right, y down, z ahead.
struct CameraPath {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< at time 0 [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< [m/s]
  Eigen::Vector3d swing = Eigen::Vector3d::Zero();     ///< amplitude of a sine [m]
  double swing_rate = 0.5;                             ///< [1/s]
  double yaw = 0;                                      ///< to the right [rad]
  double yaw_swing = 0;                                ///< amplitude of a sine [rad]
  double pitch = 0;                                    ///< downwards [rad]

  /// World from left camera at a time [s].
  Eigen::Isometry3d pose_at(double time) const;
};

/// A moving scene with its light and its stereo camera.
struct Scene {
  std::string name;
  std::vector<Object> objects;
  CameraPath camera;
  Eigen::Vector3d to_light = {-0.4, -0.8, -0.45};  ///< direction of the light, any length
  double ambient = 0.55;                           ///< share of the light without direction
  double baseline = 0.1;          ///< the stereo camera's, unless asked otherwise [m]
  double focal_per_width = 0.85;  ///< focal length [px] / image width [px]
};

/// The names that make_scene() takes.
const std::vector<std::string>& scene_names();

/// One of the ready scenes; the seed varies its textures and where small things stand. Throws
/// std::invalid_argument, naming the scenes there are, for another name.
Scene make_scene(std::string_view name, std::uint32_t seed);

// The ready scenes, one source file each.
Scene make_street(std::uint32_t seed);
Scene make_garden(std::uint32_t seed);
Scene make_room(std::uint32_t seed);

/// Puts objects together; each gets a texture seed of its own.
class SceneBuilder {
 public:
  SceneBuilder(std::string name, std::uint32_t seed);

  Scene& scene() { return scene_; }
  /// A random number low <= r < high, the next of the seed's sequence.
  double random(double low, double high);

  Object& rectangle(const Eigen::Vector3d& center, double half_width, double half_height,
                    const Texture& texture, double yaw = 0, double pitch = 0);
  Object& box(const Eigen::Vector3d& center, const Eigen::Vector3d& half_size,
              const Texture& texture, double yaw = 0);
  Object& sphere(const Eigen::Vector3d& center, double radius, const Texture& texture);
  /// A round pole from its foot upwards.
  Object& pole(const Eigen::Vector3d& foot, double height, double radius, const Texture& texture);
  /// The ground at height y: wide, level, from z = from to z = to.
  Object& ground(double y, double half_width, double from, double to, const Texture& texture);
  /// Leaves strewn in a ball.
  void foliage(const Eigen::Vector3d& center, double radius, int leaves, double leaf_size,
               const Texture& texture);

 private:
  Object& add(Shape shape, const Eigen::Vector3d& center, const Eigen::Vector3d& size,
              const Texture& texture);

  Scene scene_;
  std::uint32_t seed_;
  std::uint32_t drawn_ = 0;
};

}  // namespace mtstereo::render
