// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "reference/refine/gap_filling.hpp"

namespace mtstereo::reference {

/// Searches from each unknown pixel to both sides of its row; then rows without a disparity copy
/// the nearest one with, the upper of two.
inline ConfidentMap complete(const ConfidentMap& in) {
  ConfidentMap out = in;
  const int width = in.map.width, height = in.map.height;
  std::vector<int> empty;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (in.map(x, y) != 0) {
        out.confidence(x, y) = std::max<std::uint8_t>(in.confidence(x, y), 16);
        continue;
      }
      const int back = steps_to_known(in.map, x, y, -1, 0);
      const int ahead = steps_to_known(in.map, x, y, 1, 0);
      if (back == 0 && ahead == 0) {
        if (x == 0) empty.push_back(y);
        continue;
      }
      const int left = back == 0 ? 1 << 30 : in.map(x - back, y);
      const int right = ahead == 0 ? 1 << 30 : in.map(x + ahead, y);
      out.map(x, y) = std::min(left, right);
      const int nearest = back == 0 ? ahead : ahead == 0 ? back : std::min(back, ahead);
      out.confidence(x, y) = static_cast<std::uint8_t>(std::max(15 - (nearest - 1) / 4, 1));
    }
  }
  const ConfidentMap rows = out;
  for (const int y : empty) {
    int from = -1;
    for (int other = 0; other < height; ++other) {
      if (rows.map(0, other) == 0) continue;
      if (from < 0 || std::abs(other - y) < std::abs(from - y)) from = other;
    }
    for (int x = 0; x < width; ++x) {
      out.map(x, y) = from < 0 ? 1 : rows.map(x, from);
      out.confidence(x, y) = 1;
    }
  }
  return out;
}

}  // namespace mtstereo::reference
