// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <vector>

#include "support/plane.hpp"

namespace mtstereo::reference {

using test::DisparityPlane;
using test::GrayPlane;

/// The value in the middle; of two of them the larger one.
inline int middle_of(std::vector<int> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// The gray values of the left view minus those of the right one, in tiles of 16x16 px of these
/// views, from every second row and column of their map. 256: fewer than 8 pixels have a partner.
inline test::Plane<int> tile_differences(const GrayPlane& left, const GrayPlane& right,
                                         const DisparityPlane& map) {
  test::Plane<int> tiles((left.width + 15) / 16, (left.height + 15) / 16, 256);
  for (int row = 0; row < tiles.height; ++row) {
    for (int column = 0; column < tiles.width; ++column) {
      std::vector<int> differences;
      for (int y = 16 * row; y < std::min(16 * row + 16, left.height); y += 2) {
        for (int x = 16 * column; x < std::min(16 * column + 16, left.width); x += 2) {
          const int partner = x - (map(x, y) + 128) / 256;
          if (map(x, y) == 0 || partner < 0) continue;
          differences.push_back(left(x, y) - right(partner, y));
        }
      }
      if (differences.size() >= 8) tiles(column, row) = middle_of(differences);
    }
  }
  return tiles;
}

/// The same in the middle of the 5x5 tiles around each.
inline test::Plane<int> balance_of(const GrayPlane& left, const GrayPlane& right,
                                   const DisparityPlane& map) {
  const test::Plane<int> own = tile_differences(left, right, map);
  const auto middle = [&](int column, int row, int reach, int other) {
    std::vector<int> known;
    for (int y = std::max(row - reach, 0); y <= std::min(row + reach, own.height - 1); ++y) {
      for (int x = std::max(column - reach, 0); x <= std::min(column + reach, own.width - 1); ++x) {
        if (own(x, y) != 256) known.push_back(own(x, y));
      }
    }
    return known.empty() ? other : middle_of(known);
  };
  const int everywhere = middle(0, 0, 1 << 20, 0);
  test::Plane<int> around = own;
  for (int row = 0; row < own.height; ++row) {
    for (int column = 0; column < own.width; ++column) {
      around(column, row) = middle(column, row, 2, everywhere);
    }
  }
  return around;
}

/// A left view as bright as the right one, where a tile has this side [px].
inline GrayPlane balanced(const GrayPlane& left, const test::Plane<int>& balance, int tile) {
  GrayPlane out = left;
  for (int y = 0; y < left.height; ++y) {
    for (int x = 0; x < left.width; ++x) {
      const int gray = left(x, y) - balance(x / tile, y / tile);
      out(x, y) = static_cast<std::uint8_t>(std::clamp(gray, 0, 255));
    }
  }
  return out;
}

}  // namespace mtstereo::reference
