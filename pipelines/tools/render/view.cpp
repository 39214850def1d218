// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/render/view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tools/render/lens.hpp"

namespace mtstereo::render {
namespace {

using Eigen::Vector3d;

constexpr double kNear = 0.02;  // near clipping distance [m]
constexpr int kTile = 16;       // [px]
// The brightness of the sky at the bottom of the image, and what it loses up to the top; 1 = white.
constexpr double kSky = 0.95, kSkyGradient = 0.15;

}  // namespace

View::View(const Scene& scene, double time, const Settings& settings, const Camera& camera)
    : scene_(scene),
      camera_(camera),
      ideal_(left_camera(settings)),
      ideal_height_(settings.height),
      samples_(settings.samples) {
  choose_tiles(settings);
  const Eigen::Isometry3d camera_from_world = scene.camera.pose_at(time).inverse();
  placed_.reserve(scene.objects.size());
  for (const Object& object : scene.objects) {
    place(object, camera_from_world, time, scene.to_light.normalized());
  }
  // Nearest first, so that objects farther than a hit can be skipped.
  for (auto& tile : tiles_) {
    std::stable_sort(tile.begin(), tile.end(), [this](std::uint32_t a, std::uint32_t b) {
      return placed_[a].nearest < placed_[b].nearest;
    });
  }
}

// Tiles are squares of the image of a pinhole. A lens has its own: its image is as wide as that of
// the camera, and covers all rays of the camera; those through the border enclose the others.
void View::choose_tiles(const Settings& settings) {
  double width = settings.width, height = settings.height;
  tiling_ = camera_;
  if (camera_.lens) {
    const double right = settings.width - 0.5, bottom = settings.height - 0.5;
    Eigen::AlignedBox2d rays;
    for (double x = -0.5; x <= right; x += 0.5) {
      for (const double y : {-0.5, bottom}) rays.extend(camera_.direction(x, y).hnormalized());
    }
    for (double y = -0.5; y <= bottom; y += 0.5) {
      for (const double x : {-0.5, right}) rays.extend(camera_.direction(x, y).hnormalized());
    }
    tiling_.lens = nullptr;
    tiling_.focal = width / rays.sizes().x();
    tiling_.center_x = -0.5 - rays.min().x() * tiling_.focal;
    tiling_.center_y = -0.5 - rays.min().y() * tiling_.focal;
    height = rays.sizes().y() * tiling_.focal;
  }
  tiles_x_ = static_cast<int>(std::ceil(width / kTile));
  tiles_y_ = static_cast<int>(std::ceil(height / kTile));
  tiles_.resize(static_cast<std::size_t>(tiles_x_) * static_cast<std::size_t>(tiles_y_));
}

void View::place(const Object& object, const Eigen::Isometry3d& camera_from_world, double time,
                 const Vector3d& to_light) {
  const Eigen::Isometry3d world_from_object = object.pose_at(time);
  Eigen::Isometry3d eye_from_object = camera_from_world * world_from_object;
  eye_from_object.pretranslate(-camera_.pose.translation());
  eye_from_object.prerotate(camera_.pose.linear().transpose());
  const Eigen::Isometry3d object_from_eye = eye_from_object.inverse();

  Placed placed;
  placed.object = &object;
  placed.object_from_camera = object_from_eye.linear();
  placed.origin = object_from_eye.translation();
  placed.to_light = world_from_object.linear().transpose() * to_light;
  placed.nearest = 0;
  placed_.push_back(placed);
  sort_into_tiles(eye_from_object, static_cast<std::uint32_t>(placed_.size() - 1));
}

void View::sort_into_tiles(const Eigen::Isometry3d& eye_from_object, std::uint32_t index) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  const Vector3d half = bounding_box(*placed_[index].object);
  double left = kFar, right = -kFar, top = kFar, bottom = -kFar, nearest = kFar, farthest = -kFar;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3d sign((corner & 1) ? 1 : -1, (corner & 2) ? 1 : -1, (corner & 4) ? 1 : -1);
    const Vector3d p = eye_from_object * half.cwiseProduct(sign);
    nearest = std::min(nearest, p.z());
    farthest = std::max(farthest, p.z());
    const double z = std::max(p.z(), kNear);
    const double x = p.x() / z * tiling_.focal + tiling_.center_x;
    const double y = p.y() / z * tiling_.focal + tiling_.center_y;
    left = std::min(left, x), right = std::max(right, x);
    top = std::min(top, y), bottom = std::max(bottom, y);
  }
  if (farthest <= kNear) return;
  placed_[index].nearest = nearest;
  if (nearest <= kNear) {
    // Extends behind the camera, where the projection of its corners is meaningless.
    left = top = -kFar;
    right = bottom = kFar;
  }
  const auto tile_of = [](double v, int count) {
    return static_cast<int>(std::clamp(std::floor(v / kTile), -1.0, static_cast<double>(count)));
  };
  // A margin of one pixel: rays pass up to half a pixel from the centers.
  const int x0 = std::max(0, tile_of(left - 1, tiles_x_));
  const int x1 = std::min(tiles_x_ - 1, tile_of(right + 1, tiles_x_));
  const int y0 = std::max(0, tile_of(top - 1, tiles_y_));
  const int y1 = std::min(tiles_y_ - 1, tile_of(bottom + 1, tiles_y_));
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      tiles_[static_cast<std::size_t>(y) * static_cast<std::size_t>(tiles_x_) +
             static_cast<std::size_t>(x)]
          .push_back(index);
    }
  }
}

View::Nearest View::nearest(const Vector3d& direction) const {
  const cv::Point2d at = tiling_.project(direction);
  const int tile_x = std::clamp(static_cast<int>(at.x) / kTile, 0, tiles_x_ - 1);
  const int tile_y = std::clamp(static_cast<int>(at.y) / kTile, 0, tiles_y_ - 1);
  const auto& tile = tiles_[static_cast<std::size_t>(tile_y) * static_cast<std::size_t>(tiles_x_) +
                            static_cast<std::size_t>(tile_x)];
  Nearest best;
  best.hit.t = std::numeric_limits<double>::infinity();
  for (const std::uint32_t index : tile) {
    const Placed& placed = placed_[index];
    if (placed.nearest > best.hit.t) break;
    const Vector3d d = placed.object_from_camera * direction;
    const auto hit = intersect(*placed.object, placed.origin, d, kNear);
    if (hit && hit->t < best.hit.t) best = {&placed, *hit};
  }
  return best;
}

std::optional<double> View::depth(double x, double y) const {
  const Nearest found = nearest(camera_.direction(x, y));
  if (found.placed == nullptr) return std::nullopt;
  return found.hit.t;  // the z of the direction is 1, so t is the depth
}

std::optional<Seen> View::look(double x, double y) const {
  const Vector3d ray = camera_.direction(x, y);
  const Nearest found = nearest(ray);
  if (found.placed == nullptr) return std::nullopt;
  const Placed& placed = *found.placed;
  const Hit& hit = found.hit;
  const double facing = std::abs(hit.normal.dot(placed.object_from_camera * ray)) / ray.norm();
  const double lit = std::abs(hit.normal.dot(placed.to_light));
  const double shade = scene_.ambient + (1 - scene_.ambient) * lit;
  const Texture& texture = placed.object->texture;
  // Image textures are sharp: each ray has its own part of the pixel.
  const double width = footprint(hit, ray, facing) / (texture.image ? samples_ : 1);
  const double gray = shade * gray_value(texture, hit.u, hit.v, width);
  return Seen{hit.t, static_cast<float>(gray), placed.object};
}

// The width of the part of a surface that a pixel covers [m]. A pixel covers more of a slanted
// surface in one direction; this is the mean of both directions.
double View::footprint(const Hit& hit, const Vector3d& ray, double facing) const {
  const double slant = std::max(facing, 0.02);
  if (!camera_.lens) return hit.t / camera_.focal / std::sqrt(slant);
  return hit.t / std::sqrt(camera_.lens->magnification(ray) * ray.norm() * slant);
}

float View::sky(double x, double y) const {
  const Vector3d from_left = camera_.pose.linear() * camera_.direction(x, y);
  double height = 1 - ideal_.project(from_left).y / ideal_height_;
  // The wide views of lenses see more sky than the gradient is made for.
  if (camera_.lens) height = std::clamp(height, 0.0, 1.0);
  return static_cast<float>(std::max(0.0, kSky - kSkyGradient * height));
}

}  // namespace mtstereo::render
