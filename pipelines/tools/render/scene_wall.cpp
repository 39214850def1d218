// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "tools/render/scene.hpp"

namespace mtstereo::render {
namespace {

// Grain from a tenth of the distance down to a six-hundredth, so that the wall has texture at every
// scale of the image.
Texture grain(double distance) {
  Texture t;
  t.mean = 0.5, t.noise_contrast = 0.25, t.noise_size = 0.1 * distance, t.octaves = 7;
  t.persistence = 0.85;
  return t;
}

}  // namespace

Scene make_wall(const Wall& wall, std::uint32_t seed) {
  constexpr double kEverything = 15;  // half the width of what a camera sees at the distance 1
  if (wall.distances.empty()) throw std::invalid_argument("distance has no value");
  for (const double distance : wall.distances) {
    if (!(distance >= 0.05 && distance <= 1000)) {
      throw std::invalid_argument("distance must be 0.05 to 1000 m");
    }
  }
  if (!(std::abs(wall.slant) <= 60)) throw std::invalid_argument("slant must be -60 to 60 degrees");
  if (wall.slant != 0 && wall.distances.size() > 1) {
    throw std::invalid_argument("slant needs a single distance");
  }

  SceneBuilder b("wall", seed);
  const auto count = static_cast<int>(wall.distances.size());
  for (int i = 0; i < count; ++i) {
    const double z = wall.distances[static_cast<std::size_t>(i)];
    // Each wall covers its part of the central field of view [-0.5, 0.5], and the outer ones all
    // beyond it. A wall continues behind a nearer neighbor, where the other camera sees it.
    const double hidden = 0.8 / count;
    double left = i == 0 ? -kEverything : static_cast<double>(i) / count - 0.5;
    double right = i == count - 1 ? kEverything : (i + 1.0) / count - 0.5;
    if (i > 0 && wall.distances[static_cast<std::size_t>(i) - 1] < z) left -= hidden;
    if (i < count - 1 && wall.distances[static_cast<std::size_t>(i) + 1] < z) right += hidden;
    b.rectangle({z * (left + right) / 2, 0, z}, z * (right - left) / 2, kEverything * z, grain(z),
                -wall.slant * std::numbers::pi / 180);
  }
  b.scene().ambient = 0.7;
  return b.scene();
}

}  // namespace mtstereo::render
