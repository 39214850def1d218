// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "support/random.hpp"

namespace mtstereo::test {

/// Largest disparity of a map [1/256 px].
inline constexpr int kLargestDisparity = 1023 * 256 + 255;

/// A disparity map similar to that of a matcher: overlapping patches of different size with a
/// slight slant, some of them unknown. In addition, of_ten in ten of all pixels are unknown.
inline DisparityPlane patches(int width, int height, int of_ten, std::uint64_t seed) {
  Random random(seed);
  DisparityPlane map(width, height);
  const int count = width * height / 60 + 3;
  for (int i = 0; i < count; ++i) {
    const int x0 = random.between(-4, width - 1);
    const int y0 = random.between(-4, height - 1);
    const int x1 = std::min(x0 + random.between(1, 14), width);
    const int y1 = std::min(y0 + random.between(1, 14), height);
    const bool known = random.below(3) != 0;
    const int disparity = random.between(256, 12 * 256);
    const int slant = random.between(0, 48);
    for (int y = std::max(y0, 0); y < y1; ++y) {
      for (int x = std::max(x0, 0); x < x1; ++x) {
        map(x, y) = known ? disparity + slant * (x - x0) + random.below(9) : 0;
      }
    }
  }
  for (std::int32_t& d : map.pixels) {
    if (random.below(10) < of_ten) d = 0;
  }
  return map;
}

/// Independent random pixels: unknown in of_ten of ten cases, otherwise 1 .. largest.
inline DisparityPlane disparity_noise(int width, int height, int of_ten, int largest,
                                      std::uint64_t seed) {
  Random random(seed);
  DisparityPlane map(width, height);
  for (std::int32_t& d : map.pixels) {
    if (random.below(10) >= of_ten) d = random.between(1, largest);
  }
  return map;
}

/// True if every pixel of `less` is unknown or equal to that of `map`.
inline bool only_removes(const DisparityPlane& map, const DisparityPlane& less) {
  return std::equal(map.pixels.begin(), map.pixels.end(), less.pixels.begin(), less.pixels.end(),
                    [](std::int32_t before, std::int32_t d) { return d == 0 || d == before; });
}

}  // namespace mtstereo::test
