// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

#include "support/plane.hpp"

namespace mtstereo::reference {

/// Finds the connected component of a known pixel by flood fill over neighbors whose disparities
/// differ by at most `tolerance`, and marks it as seen.
inline std::vector<std::pair<int, int>> flood(const DisparityPlane& map, int tolerance,
                                              std::pair<int, int> start, GrayPlane& seen) {
  std::vector<std::pair<int, int>> component = {start};
  seen(start.first, start.second) = 1;
  for (std::size_t i = 0; i < component.size(); ++i) {
    const auto [x, y] = component[i];
    for (const auto& [u, v] : {std::pair{x - 1, y}, {x + 1, y}, {x, y - 1}, {x, y + 1}}) {
      if (u < 0 || u >= map.width || v < 0 || v >= map.height) continue;
      if (map(u, v) == 0 || seen(u, v) != 0) continue;
      if (std::abs(map(u, v) - map(x, y)) > tolerance) continue;
      seen(u, v) = 1;
      component.emplace_back(u, v);
    }
  }
  return component;
}

/// The largest weight k with (k / 255)^10 <= 10 * pixels / map's pixels, at most 255.
inline std::uint8_t area_weight(double pixels, double map_pixels) {
  int weight = 255;
  while (weight > 0 && std::pow(weight / 255.0, 10) > 10 * pixels / map_pixels) --weight;
  return static_cast<std::uint8_t>(weight);
}

/// A map, and the weights of its areas.
struct Areas {
  DisparityPlane map;
  GrayPlane weight;
};

/// Removes the connected components of fewer than `size` pixels and weighs the others.
inline Areas remove_speckles(const DisparityPlane& map, int tolerance, int size) {
  Areas areas = {map, GrayPlane(map.width, map.height)};
  GrayPlane seen(map.width, map.height);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      if (map(x, y) == 0 || seen(x, y) != 0) continue;
      const auto component = flood(map, tolerance, {x, y}, seen);
      const bool removed = static_cast<long>(component.size()) < size;
      const auto pixels = static_cast<double>(component.size());
      const std::uint8_t weight = removed ? 0 : area_weight(pixels, 1.0 * map.width * map.height);
      for (const auto& [u, v] : component) {
        areas.weight(u, v) = weight;
        if (removed) areas.map(u, v) = 0;
      }
    }
  }
  return areas;
}

}  // namespace mtstereo::reference
