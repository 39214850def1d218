// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <bit>
#include <cstdlib>

#include "reference/prepare/census.hpp"
#include "support/plane.hpp"

namespace mtstereo::reference {

using test::Plane;

/// The refined disparity of a known pixel of halved views, from the 5x5 window around it. `left`
/// and `right` are the transforms of the full views.
inline int refined_disparity(const Plane<std::uint32_t>& left, const Plane<std::uint32_t>& right,
                             const DisparityPlane& map, int max_disparity, int x, int y) {
  int known = 0, rounded = 0;
  std::array<int, 5> costs{};  // of the shifts -2 .. 2
  for (int v = std::max(y - 2, 0); v <= std::min(y + 2, map.height - 1); ++v) {
    for (int u = std::max(x - 2, 0); u <= std::min(x + 2, map.width - 1); ++u) {
      const int whole = (map(u, v) + 64) / 128;
      if (map(u, v) == 0 || whole > 2 * u) continue;  // without a partner
      ++known;
      rounded += map(u, v) - 128 * whole;
      for (int shift = -2; shift <= 2; ++shift) {
        for (const int column : {2 * u, 2 * u + 1}) {
          costs[shift + 2] += std::popcount(left.clamped(column, 2 * v) ^
                                            right.clamped(column - whole - shift, 2 * v));
        }
      }
    }
  }
  for (int shift = -2; shift <= 2; ++shift) {
    costs[shift + 2] = 32 * costs[shift + 2] + std::abs(128 * shift * known - rounded);
  }
  int best = -1;
  for (const int shift : {1, 0}) {
    if (costs[shift + 2] < costs[best + 2]) best = shift;
  }
  const int before = costs[best + 1], least = costs[best + 2], after = costs[best + 3];
  const int slope = std::max(before, after) - least;
  if (before < least || after < least || slope == 0) return map(x, y);
  const float between = static_cast<float>((before - after) * 64) / static_cast<float>(slope);
  const float off = static_cast<float>(rounded) / static_cast<float>(std::max(known, 1));
  const int refined = map(x, y) + 128 * best + static_cast<int>(between - off);
  return std::max(std::min({refined, std::max(256 * x, map(x, y)), 128 * max_disparity - 1}), 1);
}

inline DisparityPlane refine(const Plane<std::uint32_t>& left, const Plane<std::uint32_t>& right,
                             const DisparityPlane& map, int max_disparity) {
  DisparityPlane refined(map.width, map.height);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      if (map(x, y) == 0) continue;
      refined(x, y) = refined_disparity(left, right, map, max_disparity, x, y);
    }
  }
  return refined;
}

}  // namespace mtstereo::reference
