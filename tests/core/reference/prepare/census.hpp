// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <bit>

#include "stages/pixels/census_cost.hpp"
#include "support/plane.hpp"

namespace mtstereo::reference {

using test::GrayPlane;
using test::Plane;

/// For each pixel one bit per other pixel of the 5x5 window around it, row by row from the top
/// left: 1 if that pixel is darker. The pixels of the border are repeated.
inline Plane<std::uint32_t> census(const GrayPlane& image) {
  Plane<std::uint32_t> out(image.width, image.height);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      int bit = 0;
      for (int dy = -2; dy <= 2; ++dy) {
        for (int dx = -2; dx <= 2; ++dx) {
          if (dx == 0 && dy == 0) continue;
          const bool darker = image.clamped(x + dx, y + dy) < image(x, y);
          out(x, y) |= std::uint32_t{darker} << bit++;
        }
      }
    }
  }
  return out;
}

/// The census transforms of both views.
struct CensusPair {
  Plane<std::uint32_t> left, right;
};

/// Costs of one row: those of pixel x at disparity d are [x][d].
using RowCosts = std::vector<std::vector<int>>;

/// The census costs of a pair of views.
struct CensusCosts {
  Plane<std::uint32_t> left, right;
  CensusCostOptions options;

  /// Number of different bits; without a right pixel, the first pixel of the row is used.
  int bits(int x, int y, int d) const {
    return std::popcount(left.clamped(x, y) ^ right.clamped(std::max(x - d, 0), y));
  }
  /// The sum over the rows of the window. The pixels of the border are repeated.
  int column(int x, int y, int d) const {
    const int reach = options.kernel_size / 2;
    const int inside = std::clamp(x, 0, left.width - 1);
    int sum = 0;
    for (int k = -reach; k <= reach; ++k) sum += bits(inside, y + k, d);
    return sum;
  }
  /// The average over the columns of the window with binomial weights, computed by means of two
  /// values that round half up.
  int window(int x, int y, int d) const {
    const auto mean = [](int a, int b) { return (a + b + 1) / 2; };
    const int middle = column(x, y, d);
    if (options.kernel_size == 1) return middle;
    const int near = mean(column(x - 1, y, d), column(x + 1, y, d));
    if (options.kernel_size == 3) return mean(near, middle);
    const int far = mean(column(x - 2, y, d), column(x + 2, y, d));
    return mean(near, mean(middle, mean(far, middle)));
  }
  /// The disparities low .. high are expected; all are if low > high.
  int cost(int x, int y, int d, int low, int high) const {
    const bool expected = low > high || (low <= d && d <= high);
    const int penalty = expected ? 0 : options.range_penalty * options.kernel_size;
    return std::min(window(x, y, d) + penalty, 255);
  }
};

}  // namespace mtstereo::reference
