// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/holding.hpp"

#include <algorithm>
#include <cstdlib>

#include "mtstereo/parameters.hpp"

namespace mtstereo {
namespace {

constexpr int kSteps = kDisparityOne / kHeldOne;
static_assert(kLargestMaxDisparity * kHeldOne <= 65535);

/// In 1 / kHeldOne px. Unknown stays 0, and no known disparity becomes it.
int in_steps(std::int32_t disparity) {
  return std::max((disparity + kSteps / 2) / kSteps, std::min(disparity, 1));
}

bool is_same(int last, std::int32_t disparity) {
  return (last != 0) & (std::abs(last - in_steps(disparity)) <= kHeldTolerance);
}

/// The sum of the differences of a block.
int difference(GrayView view, const Image<std::uint8_t>& last, int x0, int x1, int y0, int y1) {
  int sum = 0;
  for (int y = y0; y < y1; ++y) {
    const std::uint8_t* now = view.row(y);
    const std::uint8_t* before = last.row(y);
    for (int x = x0; x < x1; ++x) sum += std::abs(now[x] - before[x]);
  }
  return sum;
}

bool is_still_around(const Image<std::uint8_t>& still, int column, int row) {
  const int right = std::min(column + 1, still.width() - 1);
  const int bottom = std::min(row + 1, still.height() - 1);
  for (int y = std::max(row - 1, 0); y <= bottom; ++y) {
    for (int x = std::max(column - 1, 0); x <= right; ++x) {
      if (still.row(y)[x] == 0) return false;
    }
  }
  return true;
}

}  // namespace

int find_still(GrayView view, const Image<std::uint8_t>& last, float noise, int y0, int y1,
               Image<std::uint8_t>& still) {
  constexpr int kParts = 16;  // of a gray value
  const int most = static_cast<int>(kParts * (kStillNoise * noise + kStillOffset));
  int count = 0;
  for (int y = y0; y < y1; y += kStillBlock) {
    const int bottom = std::min(y + kStillBlock, view.height);
    for (int column = 0; column < still.width(); ++column) {
      const int x = column * kStillBlock;
      const int right = std::min(x + kStillBlock, view.width);
      const int pixels = (right - x) * (bottom - y);
      const bool is_still = kParts * difference(view, last, x, right, y, bottom) <= most * pixels;
      still.row(y / kStillBlock)[column] = is_still ? 1 : 0;
      count += is_still;
    }
  }
  return count;
}

void place_still(const Image<std::uint8_t>& still, int scale, int column,
                 Image<std::uint8_t>& placed) {
  const auto block = [](int pixel, int blocks) {
    return std::clamp(pixel, 0, blocks * kStillBlock - 1) / kStillBlock;
  };
  const int side = scale * kStillBlock;
  for (int y = 0; y < placed.height(); ++y) {
    const int top = block(y * side, still.height());
    const int bottom = block((y + 1) * side - 1, still.height());
    for (int x = 0; x < placed.width(); ++x) {
      const int left = block(x * side + column, still.width());
      const int right = block((x + 1) * side + column - 1, still.width());
      std::uint8_t all = 1;
      for (int row = top; row <= bottom; ++row) {
        for (int i = left; i <= right; ++i) all &= still.row(row)[i];
      }
      placed.row(y)[x] = all;
    }
  }
}

void choose_least(const LeastConfidence& least, const Image<std::uint8_t>& still,
                  const Image<std::uint16_t>& last, const Image<std::int32_t>& map, int y0, int y1,
                  Image<std::uint8_t>& chosen) {
  for (int y = y0; y < y1; ++y) {
    const std::uint16_t* __restrict__ before = last.row(y);
    const std::int32_t* __restrict__ now = map.row(y);
    std::uint8_t* __restrict__ out = chosen.row(y);
    for (int column = 0; column < still.width(); ++column) {
      const bool held = is_still_around(still, column, y / kStillBlock);
      const std::uint8_t known = held ? least.known : least.usual;
      const std::uint8_t fresh = held ? least.fresh : least.usual;
      const int x = column * kStillBlock;
      const int right = std::min(x + kStillBlock, map.width());
      for (int i = x; i < right; ++i) out[i] = is_same(before[i], now[i]) ? known : fresh;
    }
  }
}

void threshold_each(const Image<std::uint8_t>& least, int y0, int y1, Image<std::int32_t>& map,
                    Image<std::uint8_t>& confidence) {
  for (int y = y0; y < y1; ++y) {
    const std::uint8_t* __restrict__ needed = least.row(y);
    std::int32_t* __restrict__ disparity = map.row(y);
    std::uint8_t* __restrict__ rating = confidence.row(y);
    for (int x = 0; x < map.width(); ++x) {
      const bool kept = rating[x] >= needed[x];
      disparity[x] = kept ? disparity[x] : kNoDisparity;
      rating[x] = kept ? rating[x] : std::uint8_t{0};
    }
  }
}

void copy_last(const Image<std::int32_t>& map, int y0, int y1, Image<std::uint16_t>& last) {
  for (int y = y0; y < y1; ++y) {
    const std::int32_t* __restrict__ from = map.row(y);
    std::uint16_t* __restrict__ to = last.row(y);
    for (int x = 0; x < map.width(); ++x) to[x] = static_cast<std::uint16_t>(in_steps(from[x]));
  }
}

}  // namespace mtstereo
