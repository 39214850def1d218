// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>

#include "support/plane.hpp"

namespace mtstereo::reference {

/// Draws thin structures into a complete map, and with `guard` empties what is more than 2 px
/// farther than something else that was found there.
inline void draw_thin_structures(const DisparityPlane& found, int least, bool guard,
                                 DisparityPlane& map, GrayPlane& confidence) {
  for (std::size_t i = 0; i < map.pixels.size(); ++i) {
    const int value = found.pixels[i];
    if (value < 0) {
      map.pixels[i] = -value;
      confidence.pixels[i] = std::max(confidence.pixels[i], static_cast<std::uint8_t>(least));
    } else if (guard && value > 0 && value - map.pixels[i] > 512) {
      map.pixels[i] = 0;
      confidence.pixels[i] = 0;
    }
  }
}

}  // namespace mtstereo::reference
