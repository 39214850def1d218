// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "render/render.hpp"

namespace mtstereo::render {

/// What a ray of the camera meets.
struct Seen {
  double depth = 0;  ///< along the optical axis [m]
  float gray = 0;    ///< shaded, 0 .. 1
  const Object* object = nullptr;
};

/// A scene at one time as one of the two cameras sees it. Objects are sorted into tiles of the
/// image, so that a ray is tested against few of them.
class View {
 public:
  /// `offset_x` is the camera's place on the left camera's x axis [m]. The scene has to outlive
  /// the view; the settings are complete()d ones.
  View(const Scene& scene, double time, const Settings& settings, double offset_x);

  /// Shoots a ray through the point (x, y) of the image [px], pixel centers being whole numbers.
  std::optional<Seen> look(double x, double y) const;

  /// The depth alone, without shading [m].
  std::optional<double> depth(double x, double y) const;

  /// Brightness of the sky at the row y, 0 .. 1.
  float sky(double y) const;

 private:
  struct Placed {
    const Object* object;
    Eigen::Matrix3d object_from_camera;
    Eigen::Vector3d origin;    // of the rays
    Eigen::Vector3d to_light;  // of length 1
    double nearest;            // depth of its nearest corner [m]
  };
  struct Nearest {
    const Placed* placed = nullptr;
    Hit hit;
  };

  void place(const Object& object, const Eigen::Isometry3d& camera_from_world, double time,
             const Eigen::Vector3d& eye, const Eigen::Vector3d& to_light);
  void sort_into_tiles(const Eigen::Isometry3d& eye_from_object, std::uint32_t index);
  Nearest nearest(const Eigen::Vector3d& direction, double x, double y) const;
  Eigen::Vector3d direction(double x, double y) const;

  const Scene& scene_;
  int width_, height_;
  double focal_;
  int tiles_x_, tiles_y_;
  std::vector<Placed> placed_;
  std::vector<std::vector<std::uint32_t>> tiles_;
};

}  // namespace mtstereo::render
