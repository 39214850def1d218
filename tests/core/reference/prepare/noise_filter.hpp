// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "support/plane.hpp"

namespace mtstereo::reference {

/// The operator 1 -2 1 in both directions.
inline int detail(const GrayPlane& view, int x, int y) {
  constexpr int kWeights[] = {1, -2, 1};
  int sum = 0;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      sum += kWeights[dy + 1] * kWeights[dx + 1] * view(x + dx, y + dy);
    }
  }
  return sum;
}

/// The standard deviation of the noise by the lower quartile of the blocks of 16x16 px. Of each
/// block every second row counts, of which at most 4 px may be below 2 or above 253.
inline float noise_level(const GrayPlane& view) {
  std::vector<int> blocks;
  for (int y0 = 1; y0 + 17 <= view.height; y0 += 16) {
    for (int x0 = 1; x0 + 17 <= view.width; x0 += 16) {
      int sum = 0;
      int extremes = 0;
      for (int y = y0; y < y0 + 16; y += 2) {
        for (int x = x0; x < x0 + 16; ++x) {
          sum += std::abs(detail(view, x, y));
          extremes += view(x, y) < 2 || view(x, y) > 253;
        }
      }
      if (extremes <= 4) blocks.push_back(sum);
    }
  }
  if (blocks.empty()) return 0;
  std::sort(blocks.begin(), blocks.end());
  const float quartile = static_cast<float>(blocks[(blocks.size() - 1) / 4]);
  return quartile * (1.2533141F / 6 / 128);
}

/// The local Wiener filter.
inline GrayPlane filter_noise(const GrayPlane& view, float threshold) {
  GrayPlane out(view.width, view.height);
  const float noise = threshold * threshold * 2401;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      constexpr int kNarrow[] = {0, 1, 6, 1, 0};
      constexpr int kWide[] = {1, 4, 6, 4, 1};
      int narrow = 0, wide = 0, sum = 0, squares = 0;
      for (int dy = -3; dy <= 3; ++dy) {
        for (int dx = -3; dx <= 3; ++dx) {
          const int gray = view.clamped(x + dx, y + dy);
          sum += gray;
          squares += gray * gray;
          if (std::abs(dx) == 3 || std::abs(dy) == 3) continue;
          narrow += kNarrow[dx + 2] * kNarrow[dy + 2] * gray;  // in 1/64
          wide += kWide[dx + 2] * kWide[dy + 2] * gray;        // in 1/256
        }
      }
      const float variance = static_cast<float>(49 * squares - sum * sum);
      const int weight = static_cast<int>(256 * variance / std::max(variance + noise, 1.0F));
      const int value = 256 * wide + weight * (4 * narrow - wide);
      out(x, y) = static_cast<std::uint8_t>((value + 32768) >> 16);
    }
  }
  return out;
}

}  // namespace mtstereo::reference
