// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/census.hpp"

#include <algorithm>
#include <cstring>

namespace mtstereo {
namespace {

constexpr int kRadius = 2;

/// Copies a row and repeats its ends.
void pad_row(const std::uint8_t* row, int width, CensusOrder order, std::uint8_t* padded) {
  std::uint8_t* inside = padded + kRadius;
  if (order == CensusOrder::kForward) {
    std::memcpy(inside, row, width);
  } else {
    std::reverse_copy(row, row + width, inside);
  }
  for (int i = 1; i <= kRadius; ++i) {
    inside[-i] = inside[0];
    inside[width - 1 + i] = inside[width - 1];
  }
}

/// One bit of each pixel: whether its neighbor is darker. Whole rows at a time, which compilers
/// turn into vectors.
void add_bit(const std::uint8_t* center, const std::uint8_t* neighbor, int bit, int width,
             std::uint8_t* out) {
  for (int x = 0; x < width; ++x) {
    out[x] = static_cast<std::uint8_t>(out[x] | ((neighbor[x] < center[x] ? 1 : 0) << bit));
  }
}

}  // namespace

void CensusImage::resize(int view_width, int height, int beyond) {
  width = view_width;
  for (Image<std::uint8_t>& image : plane) image.resize(width + beyond, height);
}

void census_rows(GrayView image, CensusOrder order, int y0, int y1, Image<std::uint8_t>& scratch,
                 CensusImage& census) {
  const int width = image.width;
  const int rows = y1 - y0 + 2 * kRadius;
  if (scratch.width() < width + 2 * kRadius || scratch.height() < rows) {
    scratch.resize(width + 2 * kRadius, rows);
  }
  for (int i = 0; i < rows; ++i) {
    const int y = std::clamp(y0 - kRadius + i, 0, image.height - 1);
    pad_row(image.row(y), width, order, scratch.row(i));
  }
  for (int y = y0; y < y1; ++y) {
    const std::uint8_t* center = scratch.row(y - y0 + kRadius) + kRadius;
    for (Image<std::uint8_t>& plane : census.plane) std::memset(plane.row(y), 0, width);
    int bit = 0;
    for (int dy = -kRadius; dy <= kRadius; ++dy) {
      const std::uint8_t* line = scratch.row(y - y0 + kRadius + dy) + kRadius;
      for (int i = -kRadius; i <= kRadius; ++i) {
        // The same neighbor has the same bit in both orders.
        const int dx = order == CensusOrder::kForward ? i : -i;
        if (dx == 0 && dy == 0) continue;
        add_bit(center, line + dx, bit % 8, width, census.plane[bit / 8].row(y));
        ++bit;
      }
    }
    for (Image<std::uint8_t>& plane : census.plane) {
      std::uint8_t* row = plane.row(y);
      std::memset(row + width, row[width - 1], plane.width() - width);
    }
  }
}

}  // namespace mtstereo
