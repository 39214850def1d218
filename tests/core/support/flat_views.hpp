// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>

#include "support/random.hpp"

namespace mtstereo::test {

/// A view of overlapping blocks, most of them nearly flat and some with texture.
inline GrayPlane flat_view(int width, int height, std::uint64_t seed) {
  Random random(seed);
  GrayPlane view(width, height, 90);
  for (int i = 0; i < 12; ++i) {
    const int x0 = random.between(-9, width - 1), y0 = random.between(-9, height - 1);
    const int x1 = std::min(x0 + random.between(5, 60), width);
    const int y1 = std::min(y0 + random.between(5, 60), height);
    const int gray = random.between(10, 180);
    const int texture = random.below(3) == 0 ? 60 : 2;
    for (int y = std::max(y0, 0); y < y1; ++y) {
      for (int x = std::max(x0, 0); x < x1; ++x) {
        view(x, y) = static_cast<std::uint8_t>(gray + random.below(texture));
      }
    }
  }
  return view;
}

}  // namespace mtstereo::test
