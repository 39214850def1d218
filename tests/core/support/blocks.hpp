// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "support/plane.hpp"
#include "support/random.hpp"

namespace mtstereo::test {

/// Blocks of constant gray value, the first of them cut off by `phase` columns; `noise` is added.
inline GrayPlane blocks(int width, int height, int phase, int noise, std::uint64_t seed) {
  Random random(seed);
  GrayPlane grays(width / 8 + 2, height / 8 + 1);
  for (std::uint8_t& gray : grays.pixels) gray = static_cast<std::uint8_t>(random.between(98, 104));
  GrayPlane view(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      view(x, y) =
          static_cast<std::uint8_t>(grays((x + phase) / 8, y / 8) + random.between(-noise, noise));
    }
  }
  return view;
}

/// The image with half of its detail replaced by the first pixel of each 8x8 px, as by compression.
inline GrayPlane with_blocks(const GrayPlane& image) {
  GrayPlane result = image;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      result(x, y) = static_cast<std::uint8_t>((image(x, y) + image(x & ~7, y & ~7)) / 2);
    }
  }
  return result;
}

inline Pair with_blocks(const Pair& pair) {
  return {with_blocks(pair.left), with_blocks(pair.right)};
}

}  // namespace mtstereo::test
