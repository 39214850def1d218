// SPDX-License-Identifier: LGPL-2.1-or-later
#include "alignment/corner_grid.hpp"

#include <algorithm>
#include <cmath>

#define HWY_TARGET_INCLUDE "alignment/corner_grid.cpp"
#include "base/simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

// Compilers vectorize these plain loops.

void gradients(const std::uint8_t* __restrict__ above, const std::uint8_t* __restrict__ here,
               const std::uint8_t* __restrict__ below, int width, std::int16_t* __restrict__ gx,
               std::int16_t* __restrict__ gy) {
  for (int x = 1; x < width - 1; ++x) {
    gx[x] = static_cast<std::int16_t>(here[x + 1] - here[x - 1]);
    gy[x] = static_cast<std::int16_t>(below[x] - above[x]);
  }
  gx[0] = gx[width - 1] = gy[0] = gy[width - 1] = 0;
}

/// Adds the products of a row of gradients, times `sign`, to the sums along the columns.
void add_products(const std::int16_t* __restrict__ gx, const std::int16_t* __restrict__ gy,
                  int width, int sign, std::int32_t* __restrict__ xx, std::int32_t* __restrict__ xy,
                  std::int32_t* __restrict__ yy) {
  for (int x = 0; x < width; ++x) {
    xx[x] += sign * gx[x] * gx[x];
    xy[x] += sign * gx[x] * gy[x];
    yy[x] += sign * gy[x] * gy[x];
  }
}

/// The smaller eigenvalues for the columns x0 .. x1 - 1.
void smaller_eigenvalues(const std::int32_t* __restrict__ xx, const std::int32_t* __restrict__ xy,
                         const std::int32_t* __restrict__ yy, int x0, int x1,
                         float* __restrict__ strengths) {
  constexpr int kHalf = kCornerWindow / 2;
  for (int x = x0; x < x1; ++x) {
    std::int32_t a = 0, b = 0, c = 0;
    for (int i = -kHalf; i <= kHalf; ++i) {
      a += xx[x + i];
      b += xy[x + i];
      c += yy[x + i];
    }
    const auto sum = static_cast<float>(a + c), difference = static_cast<float>(a - c);
    const auto mixed = static_cast<float>(2 * b);
    strengths[x] = (sum - std::sqrt(difference * difference + mixed * mixed)) / 2;
  }
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(gradients);
HWY_EXPORT(add_products);
HWY_EXPORT(smaller_eigenvalues);

namespace {

/// The cells of a view: their sides [px] and numbers.
struct Grid {
  int columns;
  int rows;
  int width;
  int height;

  Grid(int view_width, int view_height) {
    const double side = std::sqrt(1.0 * view_width * view_height / kCornerCells);
    columns = std::clamp(static_cast<int>(std::lround(view_width / side)), 1, kCornerCells);
    rows = std::clamp(static_cast<int>(std::lround(view_height / side)), 1, kMostCorners / columns);
    width = (view_width + columns - 1) / columns;
    height = (view_height + rows - 1) / rows;
  }
};

void add_row(int y, int sign, CornerScratch& scratch) {
  HWY_DYNAMIC_DISPATCH(add_products)
  (scratch.gradient_x.row(y), scratch.gradient_y.row(y), scratch.gradient_x.width(), sign,
   scratch.sums.row(0), scratch.sums.row(1), scratch.sums.row(2));
}

/// Updates the strongest corner of each cell by the corners of a row.
void keep_strongest(int y, const Grid& grid, int width, CornerScratch& scratch, Corner* strongest) {
  const float* strengths = scratch.strengths.data();
  for (int column = 0; column < grid.columns; ++column) {
    const int cell = y / grid.height * grid.columns + column;
    const int x0 = std::max(column * grid.width, kCornerMargin);
    const int x1 = std::min((column + 1) * grid.width, width - kCornerMargin);
    for (int x = x0; x < x1; ++x) {
      if (strengths[x] <= scratch.best[cell]) continue;
      scratch.best[cell] = strengths[x];
      strongest[cell] = {x, y};
    }
  }
}

void resize(int width, int height, int cells, float least, CornerScratch& scratch) {
  scratch.gradient_x.resize(width, height);
  scratch.gradient_y.resize(width, height);
  scratch.sums.resize(width, 3);
  scratch.strengths.resize(width);
  scratch.best.resize(cells);
  for (int i = 0; i < 3; ++i) std::fill_n(scratch.sums.row(i), width, 0);
  constexpr float kPixels = kCornerWindow * kCornerWindow;
  std::fill_n(scratch.best.data(), cells, kPixels * least);
}

}  // namespace

void find_corners(const Image<std::uint8_t>& view, float noise, CornerScratch& scratch,
                  std::vector<Corner>& corners) {
  constexpr int kHalf = kCornerWindow / 2;
  const int width = view.width(), height = view.height();
  corners.clear();
  if (width <= 2 * kCornerMargin || height <= 2 * kCornerMargin) return;
  const Grid grid(width, height);
  corners.assign(static_cast<std::size_t>(grid.columns) * grid.rows, Corner{-1, -1});
  resize(width, height, static_cast<int>(corners.size()),
         kSmallestGradient + kGradientOfNoise * noise, scratch);
  for (int y = 1; y < height - 1; ++y) {
    HWY_DYNAMIC_DISPATCH(gradients)
    (view.row(y - 1), view.row(y), view.row(y + 1), width, scratch.gradient_x.row(y),
     scratch.gradient_y.row(y));
  }
  for (int y = kCornerMargin - kHalf; y < kCornerMargin + kHalf; ++y) add_row(y, 1, scratch);
  for (int y = kCornerMargin; y < height - kCornerMargin; ++y) {
    add_row(y + kHalf, 1, scratch);
    HWY_DYNAMIC_DISPATCH(smaller_eigenvalues)
    (scratch.sums.row(0), scratch.sums.row(1), scratch.sums.row(2), kCornerMargin,
     width - kCornerMargin, scratch.strengths.data());
    keep_strongest(y, grid, width, scratch, corners.data());
    add_row(y - kHalf, -1, scratch);
  }
  std::erase_if(corners, [](const Corner& corner) { return corner.x < 0; });
}

}  // namespace mtstereo
#endif  // HWY_ONCE
