// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstdlib>

#include "support/plane.hpp"

namespace mtstereo::reference {

using test::Plane;

/// The median of the 5x5 pixels around each pixel; the pixels of the border are repeated.
inline GrayPlane median5(const GrayPlane& in) {
  GrayPlane out(in.width, in.height);
  for (int y = 0; y < in.height; ++y) {
    for (int x = 0; x < in.width; ++x) {
      std::array<std::uint8_t, 25> around;
      int count = 0;
      for (int dy = -2; dy <= 2; ++dy) {
        for (int dx = -2; dx <= 2; ++dx) around[count++] = in.clamped(x + dx, y + dy);
      }
      std::sort(around.begin(), around.end());
      out(x, y) = around[12];
    }
  }
  return out;
}

/// The pixel of an image that is mirrored at its border pixels.
inline int mirrored(const GrayPlane& in, int x, int y) {
  const auto mirror = [](int i, int size) {
    if (size == 1) return 0;
    if (i < 0) return -i;
    return i >= size ? 2 * size - 2 - i : i;
  };
  return in(mirror(x, in.width), mirror(y, in.height));
}

enum class Direction { kHorizontal, kVertical };

inline Plane<int> sobel(const GrayPlane& in, Direction direction) {
  constexpr int kAlong[3] = {-1, 0, 1};
  constexpr int kAcross[3] = {1, 2, 1};
  Plane<int> out(in.width, in.height);
  for (int y = 0; y < in.height; ++y) {
    for (int x = 0; x < in.width; ++x) {
      int sum = 0;
      for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 3; ++i) {
          const int weight =
              direction == Direction::kHorizontal ? kAlong[i] * kAcross[j] : kAcross[i] * kAlong[j];
          sum += weight * mirrored(in, x + i - 1, y + j - 1);
        }
      }
      out(x, y) = sum;
    }
  }
  return out;
}

/// The inverted mean edge strength, of which the range 125 .. 255 is stretched to 0 .. 255,
/// quantized to `gray_levels` equal steps.
/// Integers only: strength / 2, then * 255 / 130, then * q / 256.
inline int level(int strength, int gray_levels) {
  const long above_125 = std::max(2L * (255 - 125) - strength, 0L);  // in half gray values
  return static_cast<int>(above_125 * 255 * gray_levels / (2L * 130 * 256));
}

inline GrayPlane levels(const GrayPlane& median, int gray_levels) {
  const Plane<int> sx = sobel(median, Direction::kHorizontal);
  const Plane<int> sy = sobel(median, Direction::kVertical);
  GrayPlane out(median.width, median.height);
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      out(x, y) =
          static_cast<std::uint8_t>(level(std::abs(sx(x, y)) + std::abs(sy(x, y)), gray_levels));
    }
  }
  return out;
}

/// A value times its weight in the cost, in 1/16 of a gray value. The weight is rounded to a
/// multiple of 1/4096.
inline int weighted(int value, double share) {
  const double weight = std::round(share * 16 * 256) / 256;
  return static_cast<int>(std::floor(value * weight + 0.5));
}

/// The inputs of the cost of a pixel.
struct CostInput {
  Plane<int> gray, sobel_x, sobel_y;
};

inline CostInput cost_input(const GrayPlane& median) {
  CostInput input{Plane<int>(median.width, median.height), sobel(median, Direction::kHorizontal),
                  sobel(median, Direction::kVertical)};
  for (std::size_t i = 0; i < median.pixels.size(); ++i) {
    input.gray.pixels[i] = weighted(median.pixels[i], 0.30);
    input.sobel_x.pixels[i] = weighted(input.sobel_x.pixels[i], 0.59);
    input.sobel_y.pixels[i] = weighted(input.sobel_y.pixels[i], 0.11);
  }
  return input;
}

}  // namespace mtstereo::reference
