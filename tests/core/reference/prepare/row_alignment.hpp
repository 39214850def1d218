// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>

#include "mtstereo/alignment.hpp"
#include "stages/prepare/row_alignment.hpp"
#include "support/plane.hpp"

namespace mtstereo::reference {

/// The Catmull-Rom interpolation of four values at t between the second and the third.
inline double cubic(double t, double a, double b, double c, double d) {
  return b + t / 2 * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
}

/// A position in steps of 1/64 px as whole pixels and a fraction.
struct Split {
  explicit Split(double position) {
    const double rounded = std::floor(position * 64 + 0.5) / 64;
    whole = static_cast<int>(std::floor(rounded));
    fraction = rounded - whole;
  }
  int whole;
  double fraction;
};

inline std::uint8_t gray(double value) {
  return static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L));
}

/// The stage row_alignment in floating point: first along the columns, then along the rows. Its
/// gray values may differ by 1 from those of the stage.
inline GrayPlane align(const GrayPlane& view, const RowField& field) {
  const int width = view.width, height = view.height;
  GrayPlane rows(width, height), out(width, height);
  const auto center_of_block = [](int x) { return x / 16 * 16 + 7.5; };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Split at(field.displacement(center_of_block(x), y, width, height));
      const auto pixel = [&](int i) { return view.clamped(x, y + at.whole + i); };
      rows(x, y) = gray(cubic(at.fraction, pixel(-1), pixel(0), pixel(1), pixel(2)));
    }
  }
  const double half = width / 2.0;
  const bool rolls = std::abs(field.roll) / half > kSmallestRoll;
  const bool stretches = std::abs(field.stretch) / half > kSmallestStretch;
  if (!rolls && !stretches) return rows;
  for (int y = 0; y < height; ++y) {
    const double v = (y - (height - 1) / 2.0) / half;
    for (int x = 0; x < width; ++x) {
      const double u = (center_of_block(x) - (width - 1) / 2.0) / half;
      const double shift = (rolls ? -field.roll * v : 0) + (stretches ? field.stretch * u : 0);
      const Split at(std::clamp(shift, -128.0, 128.0));
      const auto pixel = [&](int i) { return rows.clamped(x + at.whole + i, y); };
      out(x, y) = gray(cubic(at.fraction, pixel(-1), pixel(0), pixel(1), pixel(2)));
    }
  }
  return out;
}

}  // namespace mtstereo::reference
