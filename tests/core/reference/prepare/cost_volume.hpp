// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <numeric>
#include <vector>

#include "reference/prepare/preprocess.hpp"

namespace mtstereo::reference {

/// The smoothed costs in 1/16 of a gray value, one plane of cells per disparity. A cell covers one
/// pixel, or 2 x 2 pixels with shift 1.
struct Volume {
  int shift = 0;
  std::vector<Plane<int>> slices;

  int disparities() const { return static_cast<int>(slices.size()); }
  int at(int x, int y, int d) const { return slices[d](x >> shift, y >> shift); }
};

/// Costs of every pixel at disparity d; a pixel without a right pixel has the cost of the first
/// pixel that has one.
inline Plane<int> raw_costs(const CostInput& left, const CostInput& right, int d) {
  Plane<int> costs(left.gray.width, left.gray.height);
  for (int y = 0; y < costs.height; ++y) {
    for (int column = 0; column < costs.width; ++column) {
      const int x = std::max(column, d);
      costs(column, y) = std::abs(left.gray(x, y) - right.gray(x - d, y)) +
                         std::abs(left.sobel_x(x, y) - right.sobel_x(x - d, y)) +
                         std::abs(left.sobel_y(x, y) - right.sobel_y(x - d, y));
    }
  }
  return costs;
}

/// Means of 2 x 2 pixels, first of two rows and then of two columns, each rounded half up. A last
/// odd row or column is repeated.
inline Plane<int> halved(const Plane<int>& in) {
  Plane<int> out((in.width + 1) / 2, (in.height + 1) / 2);
  const auto column_mean = [&](int x, int y) {
    return (in.clamped(x, 2 * y) + in.clamped(x, 2 * y + 1) + 1) / 2;
  };
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      out(x, y) = (column_mean(2 * x, y) + column_mean(2 * x + 1, y) + 1) / 2;
    }
  }
  return out;
}

/// Standard deviation of a Gaussian kernel of this size [px].
inline double kernel_sigma(int size) { return 0.3 * ((size - 1) * 0.5 - 1) + 0.8; }

/// Weights in 1/32768, the center in the middle. Half the resolution needs half the kernel size.
/// The mean of two pixels already has a variance of 1/4, which is subtracted from that of the
/// kernel.
inline std::vector<int> kernel(int size, int shift) {
  const double sigma = kernel_sigma(size);
  const double variance = shift == 0 ? sigma * sigma : (sigma * sigma - 0.25) / 4;
  const int radius = shift == 0 ? size / 2 : (size / 2 + 1) / 2;
  std::vector<double> shape;
  for (int k = -radius; k <= radius; ++k) {
    shape.push_back(k == 0 ? 1 : std::exp(-k * k / (2 * variance)));
  }
  const double sum = std::accumulate(shape.begin(), shape.end(), 0.0);
  std::vector<int> weights;
  for (const double value : shape) {
    weights.push_back(static_cast<int>(std::lround(value / sum * 32768)));
  }
  // The center compensates the rounding errors of all weights; 15 bits cannot hold a weight of 1.
  weights[radius] += 32768 - std::accumulate(weights.begin(), weights.end(), 0);
  weights[radius] = std::min(weights[radius], 32767);
  return weights;
}

/// Weighted sums along x or y, each product rounded half up; the cells of the border are repeated.
inline Plane<int> smoothed(const Plane<int>& in, const std::vector<int>& weights, int dx, int dy) {
  const int radius = static_cast<int>(weights.size()) / 2;
  Plane<int> out(in.width, in.height);
  for (int y = 0; y < in.height; ++y) {
    for (int x = 0; x < in.width; ++x) {
      for (int k = -radius; k <= radius; ++k) {
        out(x, y) += (in.clamped(x + k * dx, y + k * dy) * weights[k + radius] + 16384) >> 15;
      }
    }
  }
  return out;
}

inline Volume cost_volume(const CostInput& left, const CostInput& right, int disparities,
                          int kernel_size, int shift) {
  const std::vector<int> weights = kernel(kernel_size, shift);
  Volume volume;
  volume.shift = shift;
  for (int d = 0; d < disparities; ++d) {
    Plane<int> costs = raw_costs(left, right, d);
    if (shift == 1) costs = halved(costs);
    volume.slices.push_back(smoothed(smoothed(costs, weights, 1, 0), weights, 0, 1));
  }
  return volume;
}

}  // namespace mtstereo::reference
