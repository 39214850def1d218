// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <cstdlib>

#include "support/plane.hpp"

namespace mtstereo::reference {

/// For each tile of a view of this size, in 31sts, the share of the pixels at half the resolution
/// that agree in both maps, in the even rows of 5x5 tiles of 8x8 pixels.
inline test::GrayPlane share_agreement(const test::DisparityPlane& by_path,
                                       const test::DisparityPlane& by_cost, int width, int height) {
  test::GrayPlane shares((width + 15) / 16, (height + 15) / 16);
  for (int row = 0; row < shares.height; ++row) {
    for (int column = 0; column < shares.width; ++column) {
      int agreeing = 0, compared = 0;
      for (int y = std::max(8 * (row - 2), 0); y < std::min(8 * (row + 3), by_path.height);
           y += 2) {
        for (int x = std::max(8 * (column - 2), 0); x < std::min(8 * (column + 3), by_path.width);
             ++x) {
          ++compared;
          agreeing += by_path(x, y) != 0 && by_cost(x, y) != 0 &&
                      std::abs(by_path(x, y) - by_cost(x, y)) <= 256;
        }
      }
      shares(column, row) = static_cast<std::uint8_t>(31 * agreeing / std::max(compared, 1));
    }
  }
  return shares;
}

}  // namespace mtstereo::reference
