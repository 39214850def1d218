// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "tools/render/rig.hpp"
#include "tools/render/scene.hpp"
#include "tools/render/settings.hpp"

namespace mtstereo::render {

/// The result of a camera ray.
struct Seen {
  double depth = 0;  ///< along the optical axis [m]
  float gray = 0;    ///< shaded, 0 .. 1
  const Object* object = nullptr;
};

/// A scene at one time from one of the two cameras. Objects are sorted into tiles of the image, so
/// that each ray is tested against only a few of them.
class View {
 public:
  /// The scene must outlive the view. The settings are those of complete(); their size is that of
  /// the camera's image.
  View(const Scene& scene, double time, const Settings& settings, const Camera& camera);

  /// Traces a ray through the point (x, y) of the image [px]; pixel centers have integer
  /// coordinates.
  std::optional<Seen> look(double x, double y) const;

  /// Only the depth, without shading [m].
  std::optional<double> depth(double x, double y) const;

  /// Brightness of the sky in the direction of the point (x, y) of the image; 1 = white.
  float sky(double x, double y) const;

 private:
  struct Placed {
    const Object* object;
    Eigen::Matrix3d object_from_camera;
    Eigen::Vector3d origin;    // origin of the rays
    Eigen::Vector3d to_light;  // unit length
    double nearest;            // depth of its nearest corner [m]
  };
  struct Nearest {
    const Placed* placed = nullptr;
    Hit hit;
  };

  void place(const Object& object, const Eigen::Isometry3d& camera_from_world, double time,
             const Eigen::Vector3d& to_light);
  void choose_tiles(const Settings& settings);
  double footprint(const Hit& hit, const Eigen::Vector3d& ray, double facing) const;
  void sort_into_tiles(const Eigen::Isometry3d& eye_from_object, std::uint32_t index);
  Nearest nearest(const Eigen::Vector3d& direction) const;

  const Scene& scene_;
  Camera camera_;
  Camera tiling_;  // a pinhole whose image the tiles cover; it sees all that the camera sees
  int tiles_x_ = 0, tiles_y_ = 0;
  Camera ideal_;  // the left camera, without errors of the rig and without a lens
  int ideal_height_;
  int samples_;
  std::vector<Placed> placed_;
  std::vector<std::vector<std::uint32_t>> tiles_;
};

}  // namespace mtstereo::render
