// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "support/plane.hpp"

namespace mtstereo::test {

/// Random numbers that are equal on every machine (SplitMix64).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15u);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
  }
  /// A random integer 0 .. count - 1.
  int below(int count) { return static_cast<int>((next() >> 11) % count); }
  /// A random integer first .. last.
  int between(int first, int last) { return first + below(last - first + 1); }
  /// A random number 0 .. 1.
  double share() { return static_cast<double>(next() >> 11) / (std::uint64_t{1} << 53); }

 private:
  std::uint64_t state_;
};

/// Independent random pixels, 0 .. largest.
inline GrayPlane noise(int width, int height, std::uint64_t seed, int largest = 255) {
  Random random(seed);
  GrayPlane image(width, height);
  for (std::uint8_t& pixel : image.pixels) {
    pixel = static_cast<std::uint8_t>(random.below(largest + 1));
  }
  return image;
}

/// Random pixels of 0 and 255 only.
inline GrayPlane black_and_white(int width, int height, std::uint64_t seed) {
  GrayPlane image = noise(width, height, seed, 1);
  for (std::uint8_t& pixel : image.pixels) pixel = pixel == 0 ? 0 : 255;
  return image;
}

/// Rows of runs of random length and value 0 .. largest, similar to the levels of a view.
inline GrayPlane runs(int width, int height, std::uint64_t seed, int largest, int longest = 6) {
  Random random(seed);
  GrayPlane image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width;) {
      const auto value = static_cast<std::uint8_t>(random.below(largest + 1));
      for (int n = random.between(1, longest); n > 0 && x < width; --n) image(x++, y) = value;
    }
  }
  return image;
}

/// Every row of this width with values 0 .. levels - 1.
inline GrayPlane all_rows(int width, int levels) {
  int rows = 1;
  for (int x = 0; x < width; ++x) rows *= levels;
  GrayPlane image(width, rows);
  for (int y = 0; y < rows; ++y) {
    for (int x = 0, rest = y; x < width; ++x, rest /= levels) {
      image(x, y) = static_cast<std::uint8_t>(rest % levels);
    }
  }
  return image;
}

/// Overlapping rectangles with a little noise: edges and flat areas, and no two similar places.
inline GrayPlane texture(int width, int height, std::uint64_t seed) {
  Random random(seed);
  GrayPlane image(width, height, 128);
  const int rectangles = width * height / 40 + 4;
  for (int i = 0; i < rectangles; ++i) {
    const int x0 = random.between(-8, width);
    const int y0 = random.between(-8, height);
    const int x1 = std::min(x0 + random.between(3, 16), width);
    const int y1 = std::min(y0 + random.between(3, 16), height);
    const auto value = static_cast<std::uint8_t>(random.between(8, 247));
    for (int y = std::max(y0, 0); y < y1; ++y) {
      for (int x = std::max(x0, 0); x < x1; ++x) image(x, y) = value;
    }
  }
  for (std::uint8_t& pixel : image.pixels) {
    pixel = static_cast<std::uint8_t>(pixel + random.between(-3, 3));
  }
  return image;
}

/// The two views of a scene.
struct Pair {
  GrayPlane left;
  GrayPlane right;
};

/// A pair in which every point has the same disparity.
inline Pair shifted_pair(int width, int height, int disparity, std::uint64_t seed) {
  const GrayPlane scene = texture(width + disparity, height, seed);
  Pair pair{GrayPlane(width, height), GrayPlane(width, height)};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      pair.left(x, y) = scene(x, y);
      pair.right(x, y) = scene(x + disparity, y);
    }
  }
  return pair;
}

/// The part of a pair from (x, y) on: what a camera sees that has moved.
inline Pair crop(const Pair& pair, int x, int y, int width, int height) {
  Pair part{GrayPlane(width, height), GrayPlane(width, height)};
  for (int row = 0; row < height; ++row) {
    std::copy_n(&pair.left(x, y + row), width, &part.left(0, row));
    std::copy_n(&pair.right(x, y + row), width, &part.right(0, row));
  }
  return part;
}

/// The same pair with up to this much noise in both views.
inline Pair with_noise(Pair pair, Random& random, int most) {
  for (GrayPlane* view : {&pair.left, &pair.right}) {
    for (std::uint8_t& pixel : view->pixels) {
      pixel = static_cast<std::uint8_t>(std::clamp(pixel + random.between(-most, most), 0, 255));
    }
  }
  return pair;
}

/// A pair whose disparity increases from row to row and has a step in the middle. Each view has its
/// own noise, as with cameras, so that no match is perfect.
inline Pair slanted_pair(int width, int height, int largest, std::uint64_t seed) {
  const GrayPlane scene = texture(width + largest, height, seed);
  Random random(seed + 1);
  Pair pair{GrayPlane(width, height), GrayPlane(width, height)};
  const auto noisy = [&](std::uint8_t value) {
    return static_cast<std::uint8_t>(std::clamp(value + random.between(-2, 2), 0, 255));
  };
  for (int y = 0; y < height; ++y) {
    const int row_disparity = largest * y / (2 * height);
    for (int x = 0; x < width; ++x) {
      pair.left(x, y) = noisy(scene(x, y));
      const int disparity = row_disparity + (x > width / 2 ? largest / 2 : 0);
      pair.right(x, y) = noisy(scene(x + disparity, y));
    }
  }
  return pair;
}

/// Frames before a camera that moves down and to the right along a flat scene, with noise.
inline std::vector<Pair> moving_frames(int count, int width, int height) {
  const Pair wide = slanted_pair(width + 3 * count, height + count, 30, 9);
  Random random(5);
  std::vector<Pair> frames;
  for (int i = 0; i < count; ++i) {
    frames.push_back(with_noise(crop(wide, 3 * i, i, width, height), random, 6));
  }
  return frames;
}

}  // namespace mtstereo::test

namespace mtstereo {

using test::Random;

}  // namespace mtstereo
