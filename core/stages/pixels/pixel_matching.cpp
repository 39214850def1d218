// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixels/pixel_matching.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "mtstereo/image.hpp"
#include "stages/pixels/subpixel.hpp"

namespace mtstereo {
namespace {

/// Costs of one pixel at all disparities.
struct PixelCosts {
  const std::uint16_t* first;
  std::ptrdiff_t stride;
  int operator[](int d) const { return first[d * stride]; }
};

/// The right pixel's disparity of least cost; the smallest one of equal costs.
int best_of_right(const CostVolume& volume, int x, int y, int width) {
  const int count = std::min(volume.disparities, width - x);
  int best = 0;
  for (int d = 1; d < count; ++d) {
    if (volume.at(x + d, y, d) < volume.at(x + best, y, best)) best = d;
  }
  return best;
}

/// The least cost of the disparities first .. last that differ from `best` by more than 1.
int runner_up_cost(const PixelCosts& costs, int best, int first, int last) {
  int least = std::numeric_limits<int>::max();
  for (int d = first; d <= last; ++d) {
    if (std::abs(d - best) > 1) least = std::min(least, costs[d]);
  }
  return least;
}

}  // namespace

void PixelMatchingScratch::resize(int width) {
  low.resize(width);
  high.resize(width);
}

void match_pixels(const CostVolume& volume, const PixelMatchingOptions& options, int y0, int y1,
                  PixelMatchingScratch& scratch, Image<std::int32_t>& map,
                  Image<std::uint8_t>& ratio) {
  constexpr int kNothing = std::numeric_limits<int>::max();
  const SelectionOptions& selection = options.selection;
  const int width = map.width();
  for (int y = y0; y < y1; ++y) {
    std::int32_t* row = map.row(y);
    find_search_ranges(row, width, options.range, scratch.low.data(), scratch.high.data());
    for (int x = 0; x < width; ++x) {
      row[x] = kNoDisparity;
      ratio.row(y)[x] = 0;
      const int largest = std::min(volume.disparities - 1, x);
      const int low = scratch.low[x];
      const int high = std::min<int>(scratch.high[x], largest);
      if (low > high) continue;

      const PixelCosts costs{volume.row(y) + (x >> volume.shift), volume.stride};
      int best = low;
      for (int d = low + 1; d <= high; ++d) {
        if (costs[d] < costs[best]) best = d;
      }
      const int second = selection.runner_up_in_range ? runner_up_cost(costs, best, low, high)
                                                      : runner_up_cost(costs, best, 0, largest);
      const int cost = costs[best];
      if (second == kNothing || !(second > cost * (1 + selection.confidence))) continue;
      if (selection.left_right_tolerance >= 0 &&
          std::abs(best_of_right(volume, x - best, y, width) - best) >
              selection.left_right_tolerance) {
        continue;
      }
      int disparity = best * kDisparityOne;
      if (selection.subpixel && best > 0 && best < largest) {
        const int before = costs[best - 1];
        const int after = costs[best + 1];
        if (before >= cost && after >= cost) disparity += parabola_offset(before, cost, after);
      }
      row[x] = std::max(disparity, 1);
      ratio.row(y)[x] = static_cast<std::uint8_t>(std::max(peak_ratio(cost, second), 1));
    }
  }
}

}  // namespace mtstereo
