// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>

#include "mtstereo/alignment.hpp"
#include "support/random.hpp"

namespace mtstereo::test {

/// A texture that is defined between the pixels as well: random values at the points of a lattice,
/// interpolated smoothly, in two sizes.
class SmoothTexture {
 public:
  explicit SmoothTexture(std::uint64_t seed) : seed_(seed) {}

  /// The gray value at a point, 8 .. 247.
  double operator()(double x, double y) const {
    return 127.5 + 75 * layer(x / 7.3, y / 7.1, 1) + 45 * layer(x / 3.3, y / 3.6, 2);
  }

 private:
  /// -1 .. 1.
  double layer(double x, double y, std::uint64_t layer) const {
    const double x0 = std::floor(x), y0 = std::floor(y);
    const double fx = smooth(x - x0), fy = smooth(y - y0);
    const auto at = [&](int i, int j) {
      return value(static_cast<long>(x0) + i, static_cast<long>(y0) + j, layer);
    };
    const double upper = at(0, 0) + fx * (at(1, 0) - at(0, 0));
    const double lower = at(0, 1) + fx * (at(1, 1) - at(0, 1));
    return upper + fy * (lower - upper);
  }
  static double smooth(double t) { return t * t * t * (10 + t * (6 * t - 15)); }
  double value(long x, long y, std::uint64_t layer) const {
    Random random(seed_ * 7919 + layer * 104729 + static_cast<std::uint64_t>(x) * 2654435761U +
                  static_cast<std::uint64_t>(y) * 40503);
    random.next();
    return random.between(-1000, 1000) / 1000.0;
  }
  std::uint64_t seed_;
};

/// How a pair is taken.
struct FieldPair {
  int width = 320;
  int height = 200;
  RowField field;
  double disparity = 12;  ///< of the center [px]
  double slant = 0.03;    ///< change of the disparity per row [px]
  int noise = 0;          ///< largest error of a gray value
  double right_gain = 1;  ///< contrast of the right view
  std::uint64_t seed = 1;
};

/// The pair of a slanted plane whose right view has exactly this row field.
inline Pair taken_as(const FieldPair& options) {
  const SmoothTexture texture(options.seed);
  Random random(options.seed + 1000);
  Pair pair{GrayPlane(options.width, options.height), GrayPlane(options.width, options.height)};
  const auto gray = [&](double value) {
    const double noise = options.noise > 0 ? random.between(-options.noise, options.noise) : 0;
    return static_cast<std::uint8_t>(std::clamp(std::lround(value + noise), 0L, 255L));
  };
  const auto disparity = [&](double y) {
    return options.disparity + options.slant * (y - options.height / 2.0);
  };
  for (int y = 0; y < options.height; ++y) {
    for (int x = 0; x < options.width; ++x) {
      pair.left(x, y) = gray(texture(x, y));
      double y_left = y;
      for (int i = 0; i < 5; ++i) {
        y_left = y - options.field.displacement(x, y_left, options.width, options.height);
      }
      const double value = texture(x + disparity(y_left), y_left);
      pair.right(x, y) = gray(127.5 + options.right_gain * (value - 127.5));
    }
  }
  return pair;
}

}  // namespace mtstereo::test
