// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "base/buffer.hpp"
#include "mtstereo/image.hpp"

namespace mtstereo {

/// Finds points of a reduced view that can be located in both directions, at most one in each cell
/// of a grid, so that they cover the image.

/// A pixel of a reduced view.
struct Corner {
  int x;
  int y;
};

/// About this many cells cover the image; a grid never has more than kMostCorners.
inline constexpr int kCornerCells = 400;
inline constexpr int kMostCorners = 640;

/// Distance of corners from the border [px].
inline constexpr int kCornerMargin = 9;

/// The window whose gradients are examined [px], and the smallest mean square gradient along the
/// direction in which it is smallest [squares of gray values of the reduced view per 2 px]: that of
/// a faint texture, plus what noise of variance 1 adds, with a margin for the strongest place of a
/// cell.
inline constexpr int kCornerWindow = 7;
inline constexpr float kSmallestGradient = 9;
inline constexpr float kGradientOfNoise = 2 * 2.6F;

/// The gradients' products, summed up over windows. Memory that successive views share.
struct CornerScratch {
  Image<std::int16_t> gradient_x, gradient_y;
  Image<std::int32_t> sums;  ///< of x x, x y, y y along the columns: three rows
  Buffer<float> strengths;   ///< smaller eigenvalues of a row
  Buffer<float> best;        ///< of each cell
};

/// Fills `corners` with the strongest corner of each cell, row by row of cells, if it is strong
/// enough for a reduced view with noise of this variance. The strength is the smaller eigenvalue of
/// the sum of the products of the gradients.
void find_corners(const Image<std::uint8_t>& view, float noise, CornerScratch& scratch,
                  std::vector<Corner>& corners);

}  // namespace mtstereo
