// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "reference/prepare/time_filter.hpp"
#include "reference/refine/holding.hpp"
#include "stages/prepare/camera_motion.hpp"
#include "support/plane.hpp"

namespace mtstereo::reference {

/// The offset of a block in 1/8 px: where it was, less where it is.
struct Offset {
  int x, y;
};
using Offsets = test::Plane<std::optional<Offset>>;

/// The disparity of each 8x8 block of the left view: the median of 16 of its pixels in the last
/// map, whose pixels are `scale` times larger and begin at `column`.
inline test::Plane<std::optional<float>> block_disparities(const DisparityPlane& map, int scale,
                                                           int column, int width, int height) {
  test::Plane<std::optional<float>> out((width + 7) / 8, (height + 7) / 8);
  for (int v = 0; v < out.height; ++v) {
    for (int u = 0; u < out.width; ++u) {
      std::vector<int> known;
      for (const int dy : {1, 3, 4, 6}) {
        for (const int dx : {1, 3, 4, 6}) {
          const int left = 8 * u + dx - column, x = left / scale, y = (8 * v + dy) / scale;
          const bool inside = left >= 0 && x < map.width && y < map.height;
          if (inside && map(x, y) != 0) known.push_back(in_thirty_seconds(map(x, y)));
        }
      }
      if (known.empty()) continue;
      std::sort(known.begin(), known.end());
      out(u, v) =
          static_cast<float>(scale * known[known.size() / 2]) / 32 + static_cast<float>(column);
    }
  }
  return out;
}

/// The offsets of the blocks of the left view (0) or of the right one (1). The nearest block of the
/// last view that moves to a block decides; those that none moves to take the offset of the block
/// before them or above, or else of the block after them or below.
inline Offsets offsets(const CameraMotion& motion,
                       const test::Plane<std::optional<float>>& disparities, int side, int width,
                       int height) {
  Offsets out(disparities.width, disparities.height);
  test::Plane<float> nearest(disparities.width, disparities.height, -1e9F);
  const float middle_x = width / 2.0F, middle_y = height / 2.0F;
  for (int v = 0; v < out.height; ++v) {
    for (int u = 0; u < out.width; ++u) {
      if (!disparities(u, v)) continue;
      const ScenePoint last = {8 * u + 3.5F, 8 * v + 3.5F, *disparities(u, v)};
      const ScenePoint now = motion.moved({last.x - middle_x, last.y - middle_y, last.disparity});
      const float x = now.x + middle_x - (side == 1 ? now.disparity : 0), y = now.y + middle_y;
      if (!(x >= 0 && x < width && y >= 0 && y < height)) continue;
      const int column = static_cast<int>(x) / 8, row = static_cast<int>(y) / 8;
      if (now.disparity <= nearest(column, row)) continue;
      const float from = last.x - (side == 1 ? last.disparity : 0);
      nearest(column, row) = now.disparity;
      out(column, row) = Offset{static_cast<int>(std::floor((from - x) * 8 + 0.5F)),
                                static_cast<int>(std::floor((last.y - y) * 8 + 0.5F))};
    }
  }
  const auto take = [&](int u, int v, int du, int dv) {
    const bool inside = u + du >= 0 && u + du < out.width && v + dv >= 0 && v + dv < out.height;
    if (inside && !out(u, v)) out(u, v) = out(u + du, v + dv);
  };
  for (int v = 0; v < out.height; ++v) {
    for (int u = 0; u < out.width; ++u) {
      take(u, v, -1, 0);
      take(u, v, 0, -1);
    }
  }
  for (int v = out.height - 1; v >= 0; --v) {
    for (int u = out.width - 1; u >= 0; --u) {
      take(u, v, 1, 0);
      take(u, v, 0, 1);
    }
  }
  return out;
}

/// Moves the means of a view. A block that was not inside the last view takes the view.
inline void move(const GrayPlane& view, const Offsets& offsets, PastView& past) {
  const PastView last = past;
  for (int v = 0; v < offsets.height; ++v) {
    for (int u = 0; u < offsets.width; ++u) {
      const auto [x, y] = offsets(u, v).value_or(Offset{-1 << 20, 0});
      const int left = 64 * u + x, top = 64 * v + y;
      const bool inside = left >= 0 && top >= 0 && left + 64 <= 8 * (view.width - 1) &&
                          top + 64 <= 8 * (view.height - 1);
      past.frames(u, v) = inside ? last.frames((left / 8 + 4) / 8, (top / 8 + 4) / 8) : 0;
      for (int j = 8 * v; j < std::min(8 * v + 8, view.height); ++j) {
        for (int i = 8 * u; i < std::min(8 * u + 8, view.width); ++i) {
          int mean = 16 * view(i, j);
          if (inside) {
            const double from_x = i + x / 8.0, from_y = j + y / 8.0;
            const int column = static_cast<int>(from_x), row = static_cast<int>(from_y);
            const double right = from_x - column, below = from_y - row;
            const double above_row =
                (1 - right) * last.mean(column, row) + right * last.mean(column + 1, row);
            const double below_row =
                (1 - right) * last.mean(column, row + 1) + right * last.mean(column + 1, row + 1);
            const double steps =
                8 * above_row + std::floor(8 * (below_row - above_row) * below + 0.5);
            mean = static_cast<int>(std::floor((steps + 4) / 8));
          }
          past.mean(i, j) = mean;
          past.filtered(i, j) = static_cast<std::uint8_t>((mean + 8) / 16);
        }
      }
    }
  }
}

}  // namespace mtstereo::reference
