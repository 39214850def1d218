// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "stages/prepare/view_blur.hpp"
#include "support/plane.hpp"

namespace mtstereo::reference {

using test::Plane;

/// The stage view_blur, pixel by pixel.
inline GrayPlane blur(const GrayPlane& view, const BlurKernel& kernel) {
  const auto weight = [&](int i) { return int{kernel.weights[std::abs(i)]}; };
  Plane<int> columns(view.width, view.height);  // 1/64 gray values
  GrayPlane out(view.width, view.height);
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      int sum = 2;
      for (int i = -kernel.radius; i <= kernel.radius; ++i) {
        sum += weight(i) * view.clamped(x, y + i);
      }
      columns(x, y) = sum / 4;
    }
  }
  // A product of two 16-bit numbers as fractions of 32768, rounded half up.
  const auto product = [](int value, int w) { return (value * w * 128 + (1 << 14)) >> 15; };
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      int sum = 32 + product(columns(x, y), weight(0));
      for (int i = 1; i <= kernel.radius; ++i) {
        sum += product(columns.clamped(x - i, y) + columns.clamped(x + i, y), weight(i));
      }
      out(x, y) = static_cast<std::uint8_t>(sum / 64);
    }
  }
  return kernel.radius == 0 ? view : out;
}

}  // namespace mtstereo::reference
