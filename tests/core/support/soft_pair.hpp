// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>

#include "support/random.hpp"

namespace mtstereo::test {

/// The image smoothed along the rows, as by a soft lens.
inline GrayPlane softened(const GrayPlane& image) {
  constexpr std::array kWeights = {1, 6, 15, 20, 15, 6, 1};
  GrayPlane soft = image;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      int sum = 32;
      for (int i = 0; i < 7; ++i) sum += kWeights[i] * image.clamped(x + i - 3, y);
      soft(x, y) = static_cast<std::uint8_t>(sum / 64);
    }
  }
  return soft;
}

inline Pair softened(const Pair& pair) { return {softened(pair.left), softened(pair.right)}; }

}  // namespace mtstereo::test
