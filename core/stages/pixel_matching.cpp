// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixel_matching.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mtstereo/image.hpp"

namespace mtstereo {
namespace {

/// Costs of one pixel at all disparities.
struct PixelCosts {
  const std::uint16_t* first;
  std::ptrdiff_t stride;
  int operator[](int d) const { return first[d * stride]; }
};

/// Where the parabola through three costs has its minimum, from the middle one, which is the
/// smallest: -1/2 .. 1/2 px in 1 / kDisparityOne px.
int parabola_offset(int before, int best, int after) {
  const int curvature = before - 2 * best + after;
  if (curvature <= 0) return 0;
  return (before - after) * (kDisparityOne / 2) / curvature;
}

}  // namespace

void match_pixels(const CostVolume& volume, const PixelMatchingOptions& options, int y0, int y1,
                  Image<std::int32_t>& map) {
  constexpr int kNothing = std::numeric_limits<int>::max();
  for (int y = y0; y < y1; ++y) {
    std::int32_t* row = map.row(y);
    for (int x = 0; x < map.width(); ++x) {
      if (row[x] == kNoDisparity) continue;
      const double guess = static_cast<double>(row[x]) / kDisparityOne;
      row[x] = kNoDisparity;
      const double reach = std::max(guess * options.search_range, 1.0 * kMinSearch);
      const int largest = std::min(volume.disparities - 1, x);
      const int low = std::max(static_cast<int>(std::ceil(guess - reach)), 0);
      const int high = std::min(static_cast<int>(std::floor(guess + reach)), largest);
      if (low > high) continue;

      const PixelCosts costs{volume.row(y) + (x >> volume.shift), volume.stride};
      int best = low;
      for (int d = low + 1; d <= high; ++d) {
        if (costs[d] < costs[best]) best = d;
      }
      int second = kNothing;
      for (int d = low; d <= high; ++d) {
        if (std::abs(d - best) > 1) second = std::min(second, costs[d]);
      }
      const int cost = costs[best];
      if (second == kNothing || !(second > cost * (1 + options.confidence))) continue;
      int disparity = best * kDisparityOne;
      if (options.subpixel && best > 0 && best < largest) {
        const int before = costs[best - 1];
        const int after = costs[best + 1];
        if (before >= cost && after >= cost) disparity += parabola_offset(before, cost, after);
      }
      row[x] = std::max(disparity, 1);
    }
  }
}

}  // namespace mtstereo
