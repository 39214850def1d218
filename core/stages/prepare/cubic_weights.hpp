// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>

/// Internal to row_alignment.cpp: the weights that the kernels of all SIMD targets share.

namespace mtstereo {

/// Steps of interpolation per pixel.
inline constexpr int kPhases = 64;

/// Weights of four adjacent pixels in 1/32768, for a position between the second and the third.
using CubicWeights = std::array<std::int16_t, 4>;

/// Catmull-Rom polynomials at kPhases positions t = 0, 1/64 ...
constexpr std::array<CubicWeights, kPhases> cubic_weights() {
  std::array<CubicWeights, kPhases> table{};
  for (int i = 0; i < kPhases; ++i) {
    const double t = static_cast<double>(i) / kPhases;
    const std::array<double, 4> weights = {((2 - t) * t - 1) * t / 2, (3 * t - 5) * t * t / 2 + 1,
                                           ((4 - 3 * t) * t + 1) * t / 2, (t - 1) * t * t / 2};
    for (int k = 0; k < 4; ++k) {
      const double scaled = weights[k] * 32768;
      const int rounded = static_cast<int>(scaled < 0 ? scaled - 0.5 : scaled + 0.5);
      table[i][k] = static_cast<std::int16_t>(rounded > 32767 ? 32767 : rounded);
    }
  }
  return table;
}

}  // namespace mtstereo
