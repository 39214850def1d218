// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <bit>
#include <cstdlib>

#include "stages/pixels/census_cost.hpp"
#include "support/plane.hpp"

namespace mtstereo::reference {

using test::Plane;

/// The gray value of the view smoothed by weights 1 4 6 4 1 in both directions, rounded. The pixels
/// of the border are repeated, also around a place outside of the image.
inline int smoothed(const GrayPlane& image, int x, int y) {
  constexpr int kWeights[] = {1, 4, 6, 4, 1};
  int sum = 0;
  for (int dy = -2; dy <= 2; ++dy) {
    for (int dx = -2; dx <= 2; ++dx) {
      sum += kWeights[dy + 2] * kWeights[dx + 2] * image.clamped(x + dx, y + dy);
    }
  }
  return (sum + 128) / 256;
}

/// For each pixel one bit per neighbor: 1 if it is darker. First the eight neighbors at 1 px, row
/// by row from the top left, then those at 2 px. In one scale, then the other pixels of the 5x5
/// window; in two, those at 4 px in the smoothed view.
inline Plane<std::uint32_t> census(const GrayPlane& image, int scales = 2) {
  constexpr int kReach = 4;
  Plane<int> wide(image.width + 2 * kReach, image.height + 2 * kReach);
  for (int y = 0; y < wide.height && scales == 2; ++y) {
    for (int x = 0; x < wide.width; ++x) wide(x, y) = smoothed(image, x - kReach, y - kReach);
  }
  Plane<std::uint32_t> out(image.width, image.height);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      int bit = 0;
      const auto add = [&](int distance, auto&& gray) {
        for (int dy = -distance; dy <= distance; dy += distance) {
          for (int dx = -distance; dx <= distance; dx += distance) {
            if (dx == 0 && dy == 0) continue;
            const bool darker = gray(x + dx, y + dy) < gray(x, y);
            out(x, y) |= std::uint32_t{darker} << bit++;
          }
        }
      };
      const auto fine = [&](int column, int row) { return int{image.clamped(column, row)}; };
      const auto coarse = [&](int column, int row) { return wide(column + kReach, row + kReach); };
      add(1, fine);
      add(2, fine);
      if (scales == 2) {
        add(kReach, coarse);
        continue;
      }
      for (int dy = -2; dy <= 2; ++dy) {
        for (int dx = -2; dx <= 2; ++dx) {
          if (std::abs(dx * dy) != 2) continue;
          const bool darker = fine(x + dx, y + dy) < fine(x, y);
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

/// In place of a cost: the disparity is outside of the pixel's window.
inline constexpr int kOutside = -1;

/// The census costs of a pair of views.
struct CensusCosts {
  Plane<std::uint32_t> left, right;
  CensusCostOptions options;
  const GrayPlane* left_gray = nullptr;  ///< as bright as the right view; nullptr: no gray values
  const GrayPlane* right_gray = nullptr;

  /// Number of different bits; without a right pixel, the first pixel of the row is used.
  int bits(int x, int y, int d) const {
    return std::popcount(left.clamped(x, y) ^ right.clamped(std::max(x - d, 0), y));
  }
  /// The sums over the rows of the window, for row y. The pixels of the border are repeated.
  RowCosts columns(int y) const {
    const int reach = options.kernel_size / 2;
    RowCosts sums(left.width, std::vector<int>(options.disparities));
    for (int x = 0; x < left.width; ++x) {
      for (int d = 0; d < options.disparities; ++d) {
        for (int k = -reach; k <= reach; ++k) sums[x][d] += bits(x, y + k, d);
      }
    }
    return sums;
  }
  /// The average over the columns of the window with binomial weights, computed by means of two
  /// values that round half up.
  int window(const RowCosts& columns, int x, int d) const {
    const auto column = [&](int at) { return columns[std::clamp(at, 0, left.width - 1)][d]; };
    const auto mean = [](int a, int b) { return (a + b + 1) / 2; };
    const int middle = column(x);
    if (options.kernel_size == 1) return middle;
    const int near = mean(column(x - 1), column(x + 1));
    if (options.kernel_size == 3) return mean(near, middle);
    const int far = mean(column(x - 2), column(x + 2));
    return mean(near, mean(middle, mean(far, middle)));
  }
  /// What the difference of the gray values of a pixel costs.
  int gray(int x, int y, int d) const {
    if (left_gray == nullptr) return 0;
    const int difference = (*left_gray)(x, y) - (*right_gray)(std::max(x - d, 0), y);
    return 2 * std::min(std::abs(difference), 10);
  }
  /// The cost of pixel x in row y, that of these columns. The disparities low .. high are expected.
  int cost(const RowCosts& columns, int x, int y, int d, int low, int high) const {
    const bool expected = low <= d && d <= high;
    const int penalty = expected ? 0 : options.range_penalty * options.kernel_size;
    return std::min(window(columns, x, d) + gray(x, y, d) + penalty, 255);
  }
};

}  // namespace mtstereo::reference
