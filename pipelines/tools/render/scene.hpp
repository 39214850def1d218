// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "tools/render/shapes.hpp"

namespace mtstereo::render {

/// [rad]
inline constexpr double kQuarterTurn = std::numbers::pi / 2;

/// The motion of the left camera. World and camera axes: x right, y down, z forward.
struct CameraPath {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< at time 0 [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< [m/s]
  Eigen::Vector3d swing = Eigen::Vector3d::Zero();     ///< amplitude of a sine [m]
  double swing_rate = 0.5;                             ///< [1/s]
  double yaw = 0;                                      ///< to the right [rad]
  double yaw_swing = 0;                                ///< amplitude of a sine [rad]
  double pitch = 0;                                    ///< downwards [rad]

  /// The transform from left camera to world at a time [s].
  Eigen::Isometry3d pose_at(double time) const;
};

/// A moving scene with its light and its stereo camera.
struct Scene {
  std::string name;
  std::vector<Object> objects;
  CameraPath camera;
  Eigen::Vector3d to_light = {-0.4, -0.8, -0.45};  ///< direction towards the light, any length
  double ambient = 0.55;                           ///< fraction of undirected light
  double baseline = 0.1;                           ///< default of the stereo camera [m]
  double focal_per_width = 0.85;                   ///< focal length [px] / image width [px]
};

/// The scene names for make_scene().
const std::vector<std::string>& scene_names();

/// One of the built-in scenes; the seed varies its textures and the positions of small objects.
/// Throws std::invalid_argument, listing the scenes, for any other name.
Scene make_scene(std::string_view name, std::uint32_t seed);

// The built-in scenes, one source file each.
Scene make_street(std::uint32_t seed);
Scene make_garden(std::uint32_t seed);
Scene make_room(std::uint32_t seed);

/// What the thin structures are.
enum class ThinKind {
  kPosts,    ///< upright bars
  kLeaning,  ///< bars that lean by 0.2 to 0.6 px per row
  kRails,    ///< level bars
  kWires,    ///< nearly level bars: 0.06 to 0.2 rows per column
  kFence,    ///< two fences of upright bars, with gaps of twice their width
  kStems,    ///< stems of plants, with leaves
};

/// Thin structures in front of a slanted wall.
struct Thin {
  ThinKind kind = ThinKind::kPosts;
  double width = 3;  ///< of a bar along a row, or along a column [px of a view 640 px wide]
};

/// The scene with these things, at disparities 5 to 45 px above those of the wall in a view 640 px
/// wide. Its first object is the wall; the others are the structures. Throws std::invalid_argument,
/// naming the setting.
Scene make_thin(const Thin& thin, std::uint32_t seed);

/// Collects the objects of a scene; each has its own texture seed.
class SceneBuilder {
 public:
  SceneBuilder(std::string name, std::uint32_t seed);

  Scene& scene() { return scene_; }
  /// The next random number low <= r < high of the seed's sequence.
  double random(double low, double high);

  Object& rectangle(const Eigen::Vector3d& center, double half_width, double half_height,
                    const Texture& texture, double yaw = 0, double pitch = 0);
  Object& box(const Eigen::Vector3d& center, const Eigen::Vector3d& half_size,
              const Texture& texture, double yaw = 0);
  Object& sphere(const Eigen::Vector3d& center, double radius, const Texture& texture);
  /// A vertical round pole; `foot` is its lower end.
  Object& pole(const Eigen::Vector3d& foot, double height, double radius, const Texture& texture);
  /// A wide horizontal ground plane at height y, from z = from to z = to.
  Object& ground(double y, double half_width, double from, double to, const Texture& texture);
  /// Leaves at random positions in a ball.
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
