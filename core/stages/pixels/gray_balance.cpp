// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixels/gray_balance.hpp"

#include <algorithm>

#include "stages/pixels/gray_differences.hpp"

namespace mtstereo {
namespace {

void add_row(GrayView left, GrayView right, const Image<std::int32_t>& map,
             const GrayMapping& mapping, int y, int x0, int x1, GrayDifferences& differences) {
  const std::uint8_t* of_left = left.row(y);
  const std::uint8_t* of_right = right.row(y);
  const std::int32_t* disparity = map.row(y);
  for (int x = x0; x < x1; x += kBalanceStep) {
    if (disparity[x] == kNoDisparity) continue;
    const int partner = x - (disparity[x] + kDisparityOne / 2) / kDisparityOne;
    if (partner >= 0) differences.add(of_left[x] - mapping.of(of_right[partner]));
  }
}

/// The median of the tiles' own differences in a rectangle of tiles, without those outside of the
/// view; `other` if no tile has one.
std::int16_t median(const Image<std::int16_t>& own, int x0, int y0, int x1, int y1,
                    std::int16_t other) {
  GrayDifferences differences;
  for (int y = std::max(y0, 0); y <= std::min(y1, own.height() - 1); ++y) {
    for (int x = std::max(x0, 0); x <= std::min(x1, own.width() - 1); ++x) {
      if (own.row(y)[x] != kNoDifference) differences.add(own.row(y)[x]);
    }
  }
  return differences.pixels() == 0 ? other : static_cast<std::int16_t>(differences.median());
}

int tiles(int length) { return (length + kBalanceTile - 1) / kBalanceTile; }

}  // namespace

void GrayBalance::resize(int width, int height) {
  own.resize(tiles(width), tiles(height));
  around.resize(tiles(width), tiles(height));
}

void measure_differences(GrayView left, GrayView right, const Image<std::int32_t>& map, int row0,
                         int row1, GrayBalance& balance) {
  for (int row = row0; row < row1; ++row) {
    const int y1 = std::min((row + 1) * kBalanceTile, map.height());
    for (int column = 0; column < balance.own.width(); ++column) {
      const int x0 = column * kBalanceTile, x1 = std::min(x0 + kBalanceTile, map.width());
      GrayDifferences differences;
      for (int y = row * kBalanceTile; y < y1; y += kBalanceStep) {
        add_row(left, right, map, balance.mapping, y, x0, x1, differences);
      }
      const bool enough = differences.pixels() >= kFewestBalanced;
      balance.own.row(row)[column] =
          enough ? static_cast<std::int16_t>(differences.median()) : kNoDifference;
    }
  }
}

std::int16_t common_difference(const GrayBalance& balance) {
  return median(balance.own, 0, 0, balance.own.width() - 1, balance.own.height() - 1, 0);
}

void balance_tiles(std::int16_t common, int row0, int row1, GrayBalance& balance) {
  constexpr int kReach = kBalanceReach;
  for (int y = row0; y < row1; ++y) {
    for (int x = 0; x < balance.own.width(); ++x) {
      balance.around.row(y)[x] =
          median(balance.own, x - kReach, y - kReach, x + kReach, y + kReach, common);
    }
  }
}

void balance_row(GrayView left, int y, const GrayBalance& balance, int tile,
                 std::uint8_t* __restrict__ out) {
  const std::uint8_t* __restrict__ gray = left.row(y);
  const std::int16_t* differences = balance.around.row(y / tile);
  for (int x0 = 0; x0 < left.width; x0 += tile) {
    const int difference = differences[x0 / tile];
    const int x1 = std::min(x0 + tile, left.width);
    for (int x = x0; x < x1; ++x) {
      out[x] = static_cast<std::uint8_t>(std::clamp(gray[x] - difference, 0, 255));
    }
  }
}

}  // namespace mtstereo
