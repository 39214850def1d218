// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <map>

#include "reference/refine/gap_filling.hpp"

namespace mtstereo::reference {

/// Whether a jump of more than 2 px is at most 3 columns and rows away. A jump to the next row
/// belongs to the upper row, and one to the next column to both columns. With `changed`, one of the
/// jump's pixels has a mark.
inline bool near_jump(const DisparityPlane& map, const GrayPlane* changed, int x, int y) {
  const auto counts = [&](int u, int v, int other_u, int other_v) {
    return changed == nullptr || (*changed)(u, v) != 0 || changed->clamped(other_u, other_v) != 0;
  };
  for (int v = std::max(y - 3, 0); v <= std::min(y + 3, map.height - 1); ++v) {
    for (int u = std::max(x - 4, 0); u <= std::min(x + 3, map.width - 1); ++u) {
      const bool right =
          std::abs(map(u, v) - map.clamped(u + 1, v)) > 512 && counts(u, v, u + 1, v);
      const bool down =
          u >= x - 3 && std::abs(map(u, v) - map.clamped(u, v + 1)) > 512 && counts(u, v, u, v + 1);
      if (right || down) return true;
    }
  }
  return false;
}

/// The weighted median of every third row and column of the 13x13 window, in 1/16 px.
inline int weighted_median(const GrayPlane& gray, const DisparityPlane& map, int x, int y) {
  std::map<int, int> weights;  // by disparity, ascending
  int total = 0;
  for (int dy = -6; dy <= 6; dy += 3) {
    for (int dx = -6; dx <= 6; dx += 3) {
      const int change = std::abs(gray(x, y) - gray.clamped(x + dx, y + dy));
      const int weight = 1 + std::max(24 - change, 0);
      weights[map.clamped(x + dx, y + dy) / 16] += weight;
      total += weight;
    }
  }
  int sum = 0;
  for (const auto& [disparity, weight] : weights) {
    sum += weight;
    if (2 * sum >= total) return disparity;
  }
  return 0;
}

inline ConfidentMap align_edges(const GrayPlane& gray, const ConfidentMap& in,
                                const GrayPlane* changed = nullptr) {
  ConfidentMap out = in;
  for (int y = 0; y < in.map.height; ++y) {
    for (int x = 0; x < in.map.width; ++x) {
      if (!near_jump(in.map, changed, x, y)) continue;
      const int median = weighted_median(gray, in.map, x, y);
      if (std::abs(median - in.map(x, y) / 16) < 8) continue;
      out.map(x, y) = std::max(16 * median, 1);
      out.confidence(x, y) = std::min<std::uint8_t>(in.confidence(x, y), 15);
    }
  }
  return out;
}

}  // namespace mtstereo::reference
