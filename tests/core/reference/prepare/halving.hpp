// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "support/plane.hpp"

namespace mtstereo::reference {

/// The rounded mean of 2x2 pixels; a last odd row or column is repeated.
inline GrayPlane halve(const GrayPlane& view) {
  GrayPlane half((view.width + 1) / 2, (view.height + 1) / 2);
  for (int y = 0; y < half.height; ++y) {
    for (int x = 0; x < half.width; ++x) {
      double sum = 0;
      for (const int dy : {0, 1}) {
        for (const int dx : {0, 1}) sum += view.clamped(2 * x + dx, 2 * y + dy);
      }
      half(x, y) = static_cast<std::uint8_t>(sum / 4 + 0.5);
    }
  }
  return half;
}

}  // namespace mtstereo::reference
