// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "stages/prepare/census.hpp"

namespace mtstereo {

/// The costs of guided pixel matching, row by row: differing bits of the census transforms, summed
/// over a small window, plus a penalty for disparities that the nodes do not expect. A row's costs
/// are stored pixel by pixel: cell [x][d] at x * lanes + d. Cells without a right pixel (d > x) use
/// the first pixel of the right row, so that they cost nothing where the image is flat.

struct CensusCostOptions {
  int disparities;           ///< D
  int kernel_size;           ///< side of the window over which costs are summed: 1, 3 or 5 px
  int range_penalty;         ///< added to the cost of an unexpected disparity [bits], 0 .. 32
  int bytes = kCensusBytes;  ///< census_bytes() of both views; the others are 0
};

/// Cost of the cells d >= D.
inline constexpr int kCensusNever = 255;

/// The number of a pixel's costs is a multiple of this. It is also the size of the widest vectors
/// that every step on costs can use [bytes]; some steps use wider ones if they divide that number.
inline constexpr int kCostStep = 32;

/// Number of a pixel's costs: D rounded up to whole vectors.
inline int cost_lanes(int disparities) {
  return (disparities + kCostStep - 1) / kCostStep * kCostStep;
}

/// Steps of the costs per differing bit: the number of rows over which costs are summed. Along the
/// row costs are averaged, so that one step is one bit of one row.
inline int cost_scale(const CensusCostOptions& options) { return options.kernel_size; }

/// Scratch memory of one thread, and its state between rows.
struct CensusCostScratch {
  /// Rows of both views, split into byte planes: those of the window, and the one that enters next.
  Buffer<std::uint8_t> planes;
  /// Differing bits of the window's rows, for processors that are slow to count them again when a
  /// row leaves the window; others do not access it.
  Buffer<std::uint8_t> kept;
  Buffer<std::uint8_t> sums;    ///< differing bits over the window's rows
  Buffer<std::uint8_t> tables;  ///< penalties below and above a range, and from D on

  void resize(int width, const CensusCostOptions& options);
};

/// Begins with row y. The calls of census_cost_row() that follow have to pass the rows y, y + 1 ...
/// in this order.
void start_census_costs(const CensusImage& left, const CensusImage& right,
                        const CensusCostOptions& options, int y, CensusCostScratch& scratch);

/// Writes the costs of row y, width * lanes cells. y is the row passed to start_census_costs() or
/// the one after the previous call's. Disparities outside low[x] .. high[x] cost the penalty more;
/// low > high means that the pixel has no expected range, and then there is no penalty. Sums
/// saturate at 255.
void census_cost_row(const CensusImage& left, const CensusImage& right,
                     const CensusCostOptions& options, int y, const std::uint16_t* low,
                     const std::uint16_t* high, CensusCostScratch& scratch, std::uint8_t* costs);

}  // namespace mtstereo
