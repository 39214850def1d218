// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "reference/cost_volume.hpp"
#include "support/plane.hpp"

namespace mtstereo::reference {

using test::DisparityPlane;

/// How pixels are matched: shares, not percents.
struct PixelOptions {
  double range;
  double confidence;
  bool subpixel;
};

/// The disparity of one pixel in 1/256 px that is best near `guess` px, or 0.
inline int match_pixel(const Volume& volume, const PixelOptions& options, int x, int y,
                       double guess) {
  const double reach = std::max(guess * options.range, 3.0);
  const int largest = std::min(volume.disparities() - 1, x);
  std::vector<int> candidates;
  for (int d = 0; d <= largest; ++d) {
    if (d >= guess - reach && d <= guess + reach) candidates.push_back(d);
  }
  if (candidates.empty()) return 0;
  const auto cost = [&](int d) { return volume.at(x, y, d); };
  const int best = *std::min_element(candidates.begin(), candidates.end(),
                                     [&](int a, int b) { return cost(a) < cost(b); });
  bool has_other = false;
  for (const int d : candidates) {
    if (std::abs(d - best) <= 1) continue;
    has_other = true;
    if (!(cost(d) > cost(best) * (1 + options.confidence))) return 0;
  }
  if (!has_other) return 0;
  int disparity = 256 * best;
  if (options.subpixel && best > 0 && best < largest) {
    const int before = cost(best - 1) - cost(best);
    const int after = cost(best + 1) - cost(best);
    if (before >= 0 && after >= 0 && before + after > 0) {
      disparity += 128 * (before - after) / (before + after);
    }
  }
  return std::max(disparity, 1);
}

inline DisparityPlane match_pixels(const Volume& volume, const PixelOptions& options,
                                   const DisparityPlane& map) {
  DisparityPlane out(map.width, map.height);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      if (map(x, y) != 0) out(x, y) = match_pixel(volume, options, x, y, map(x, y) / 256.0);
    }
  }
  return out;
}

}  // namespace mtstereo::reference
