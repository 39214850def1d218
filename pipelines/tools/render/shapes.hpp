// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <vector>

#include "tools/render/texture.hpp"

namespace mtstereo::render {

/// The shapes, each centered at the origin of its own coordinates.
enum class Shape {
  kRectangle,  ///< in the plane z = 0: |x| <= size.x, |y| <= size.y
  kBox,        ///< |x| <= size.x, |y| <= size.y, |z| <= size.z
  kSphere,     ///< radius size.x
  kCylinder,   ///< around the y axis: radius size.x, |y| <= size.y, open at both ends
};

/// The pattern of holes in a rectangle; rays pass through the holes.
enum class Cutout {
  kNone,
  kBars,  ///< upright bars with a rail at the top and one at the bottom
  kMesh,  ///< wires along x and y
  kLeaf,  ///< a pointed oval; everything outside is a hole
};

/// Poses that an object takes one after the other.
struct Path {
  std::vector<Eigen::Isometry3d> poses;  ///< transforms from object to world; at least one
  double rest = 0;                       ///< time at each pose [s]
  double move = 1;                       ///< time from pose to pose, more than 0 [s]

  /// The pose at a time [s]; after the last pose, the object stays there.
  Eigen::Isometry3d at(double time) const;
  /// Whether the object rests at a time.
  bool rests_at(double time) const;
};

/// The motion of an object; all zeros = at rest.
struct Motion {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< [m/s]
  Eigen::Vector3d swing = Eigen::Vector3d::Zero();     ///< amplitude of a sine [m]
  double swing_rate = 0;                               ///< [1/s]
  double swing_phase = 0;                              ///< [periods]
  double spin = 0;                                     ///< about its own y axis [rad/s]
  std::shared_ptr<const Path> path{};                  ///< replaces all of these and Object::pose
};

/// A solid object of the scene.
struct Object {
  Shape shape = Shape::kBox;
  Eigen::Vector3d size = Eigen::Vector3d::Ones();  ///< half extents [m], see Shape
  Eigen::Isometry3d pose =
      Eigen::Isometry3d::Identity();  ///< transform from object to world at time 0
  Motion motion;
  Texture texture;
  Cutout cutout = Cutout::kNone;
  double cutout_period = 0.1;  ///< from bar to bar [m]
  double cutout_solid = 0.3;   ///< solid fraction of a period

  /// The transform from object to world at a time [s].
  Eigen::Isometry3d pose_at(double time) const;
};

/// The intersection of a ray and an object, in the object's coordinates.
struct Hit {
  double t = 0;            ///< ray parameter
  Eigen::Vector3d normal;  ///< unit length
  double u = 0, v = 0;     ///< texture coordinates [m]
};

/// The first hit with t > near of the ray origin + t * direction (object's coordinates).
std::optional<Hit> intersect(const Object& object, const Eigen::Vector3d& origin,
                             const Eigen::Vector3d& direction, double near);

/// Half extents of the bounding box of the object, in its coordinates.
Eigen::Vector3d bounding_box(const Object& object);

}  // namespace mtstereo::render
