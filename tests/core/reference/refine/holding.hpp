// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "stages/prepare/camera_motion.hpp"
#include "support/plane.hpp"

namespace mtstereo::reference {

/// A disparity in 1/32 px; a known one is at least 1.
inline int in_thirty_seconds(int disparity) {
  if (disparity == 0) return 0;
  return std::max(static_cast<int>(std::floor(disparity / 8.0 + 0.5)), 1);
}

/// Whether one of the disparities 4 px to the left, to the right, above and below (or at the border
/// of the map, where that is outside) is larger by more than 2 px.
inline bool beside_nearer(const DisparityPlane& map, int x, int y) {
  bool nearer = false;
  for (const auto& [dx, dy] : {std::pair{-4, 0}, {4, 0}, {0, -4}, {0, 4}}) {
    const int column = std::clamp(x + dx, 0, map.width - 1);
    const int row = std::clamp(y + dy, 0, map.height - 1);
    nearer |= (map(column, row) - map(x, y)) / 256.0 > 2;
  }
  return nearer;
}

/// The least confidence of each pixel: the second one where the last map has the same disparity up
/// to 1 px, the third one where it knows nothing and nothing near is nearer, the first one
/// elsewhere.
inline GrayPlane least_confidence(const DisparityPlane& map, const DisparityPlane& last,
                                  const CameraMotion& motion, float offset,
                                  const std::array<std::uint8_t, 3>& least) {
  GrayPlane out(map.width, map.height, least[0]);
  const float center_x = map.width / 2.0F, center_y = map.height / 2.0F;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const ScenePoint was =
          motion.moved({x - center_x, y - center_y, map(x, y) / 256.0F + offset});
      const float last_x = std::floor(was.x + center_x + 1 + 0.5F) - 1;
      const float last_y = std::floor(was.y + center_y + 1 + 0.5F) - 1;
      if (!(last_x >= 0 && last_y >= 0 && last_x < map.width && last_y < map.height)) continue;
      const int before = last(static_cast<int>(last_x), static_cast<int>(last_y));
      const float expected = std::floor((was.disparity - offset) * 32 + 64 + 0.5F) - 64;
      if (before == 0) {
        if (!beside_nearer(map, x, y)) out(x, y) = least[2];
      } else if (std::abs(in_thirty_seconds(before) - expected) <= 32) {
        out(x, y) = least[1];
      }
    }
  }
  return out;
}

}  // namespace mtstereo::reference
