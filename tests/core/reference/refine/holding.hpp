// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "support/plane.hpp"

namespace mtstereo::reference {

using test::DisparityPlane;
using test::GrayPlane;

/// The last pair of a stream: its map and left view.
struct LastPair {
  DisparityPlane map;
  GrayPlane view;
};

/// A disparity in 1/32 px; a known one is at least 1.
inline int in_thirty_seconds(int disparity) {
  if (disparity == 0) return 0;
  return std::max(static_cast<int>(std::floor(disparity / 8.0 + 0.5)), 1);
}

/// Whether the last map knows the pixel and differs by at most 1 px.
inline bool is_same(int last, int disparity) {
  return last != 0 && std::abs(in_thirty_seconds(last) - in_thirty_seconds(disparity)) <= 32;
}

/// 1 for each block of 8x8 pixels whose mean difference is at most 1.4 times the noise plus 1, in
/// sixteenths of a gray value.
inline GrayPlane still_blocks(const GrayPlane& view, const GrayPlane& last, float noise) {
  GrayPlane still((view.width + 7) / 8, (view.height + 7) / 8);
  const int most = static_cast<int>(16 * (1.4F * noise + 1));
  for (int v = 0; v < still.height; ++v) {
    for (int u = 0; u < still.width; ++u) {
      int sum = 0, pixels = 0;
      for (int y = 8 * v; y < std::min(8 * v + 8, view.height); ++y) {
        for (int x = 8 * u; x < std::min(8 * u + 8, view.width); ++x) {
          sum += std::abs(view(x, y) - last(x, y));
          ++pixels;
        }
      }
      still(u, v) = 16 * sum <= most * pixels;
    }
  }
  return still;
}

/// These blocks in a view of this size that is `scale` times smaller and begins `column` px further
/// right: those of which all pixels are in still blocks.
inline GrayPlane placed(const GrayPlane& still, int scale, int column, int width, int height) {
  GrayPlane out((width + 7) / 8, (height + 7) / 8, 1);
  for (int y = 0; y < 8 * scale * out.height; ++y) {
    for (int x = 0; x < 8 * scale * out.width; ++x) {
      const int block = std::clamp(x + column, 0, 8 * still.width - 1) / 8;
      if (still.clamped(block, y / 8) == 0) out(x / (8 * scale), y / (8 * scale)) = 0;
    }
  }
  return out;
}

/// The least confidence of each pixel: the first one next to a block that is not still, the second
/// one where the last map has the same disparity, the third one elsewhere.
inline GrayPlane least_confidence(const DisparityPlane& map, const DisparityPlane& last,
                                  const GrayPlane& still,
                                  const std::array<std::uint8_t, 3>& least) {
  GrayPlane out(map.width, map.height);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      bool around = true;
      for (int v = y / 8 - 1; v <= y / 8 + 1; ++v) {
        for (int u = x / 8 - 1; u <= x / 8 + 1; ++u) around = around && still.clamped(u, v) == 1;
      }
      out(x, y) = !around ? least[0] : is_same(last(x, y), map(x, y)) ? least[1] : least[2];
    }
  }
  return out;
}

}  // namespace mtstereo::reference
