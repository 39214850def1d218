// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <numbers>

#include "tools/render/scene.hpp"

namespace mtstereo::test {

/// A wall at this distance [m] on the axis that fills every view; its right side is farther by
/// `slant` [degrees]. It has texture at every scale of the image.
inline render::Scene wall_scene(double distance, double slant = 0) {
  render::Texture grain;
  grain.mean = 0.5, grain.noise_contrast = 0.25, grain.noise_size = 0.1 * distance;
  grain.octaves = 7, grain.persistence = 0.85;
  render::SceneBuilder builder("wall", 1);
  builder.rectangle({0, 0, distance}, 15 * distance, 15 * distance, grain,
                    -slant * std::numbers::pi / 180);
  builder.scene().ambient = 0.7;
  return builder.scene();
}

}  // namespace mtstereo::test
