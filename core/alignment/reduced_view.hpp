// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/image.hpp"

namespace mtstereo {

/// The views in which the coarse search looks for matches: about 640 px wide, without slow changes
/// of brightness.

/// Sides of the squares of which a view of this width is reduced to one pixel each [px].
int reduction_factor(int width);

/// A reduced view. Each pixel is 128 plus kHighPassGain times the difference of the mean of its
/// square from the mean of the kHighPassSize x kHighPassSize reduced pixels around it. Squares that
/// do not fit into the view at its right and lower border are left out.
struct ReducedView {
  int factor = 1;  ///< sides of the squares [px]
  Image<std::uint8_t> gray;
  Image<std::int16_t> means;         ///< the mean of each square, in 1 / kHighPassGain
  Buffer<std::int32_t> row_sums;     ///< sums of the rows of a square, one for each column
  Buffer<std::int32_t> column_sums;  ///< sums of kHighPassSize means along the columns

  void reduce(GrayView view);
};

inline constexpr int kHighPassGain = 2;
inline constexpr int kHighPassSize = 15;

}  // namespace mtstereo
