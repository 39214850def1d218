// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "stages/prepare/census.hpp"

namespace mtstereo {

/// The costs of guided pixel matching, row by row: differing bits of the census transforms, summed
/// over a small window, and more of them where the nodes do not expect the disparity. Costs of a
/// row lie disparity by disparity: cell [x][d] at x * lanes + d. Where no right pixel is (d > x)
/// the first one of the row stands in: a cell that costs nothing where nothing is to be seen.

struct CensusCostOptions {
  int disparities;    ///< D
  int kernel_size;    ///< side of the window the costs are summed over: 1, 3 or 5 px
  int range_penalty;  ///< added where a disparity is not expected [bits], 0 .. 24
};

/// Cost of the cells d >= D.
inline constexpr int kCensusNever = 255;

/// What a pixel's costs are a multiple of, and with that the widest vectors that all work on costs
/// can use [bytes]. Single steps take wider ones where a pixel's costs are whole ones of these too.
inline constexpr int kCostStep = 32;

/// Disparities that a pixel's costs take room for: D rounded up to whole vectors.
inline int cost_lanes(int disparities) {
  return (disparities + kCostStep - 1) / kCostStep * kCostStep;
}

/// Steps of the costs per differing bit: the rows that are summed up. Across the row the costs are
/// averaged, so that one step is one bit of one row.
inline int cost_scale(const CensusCostOptions& options) { return options.kernel_size; }

/// Scratch memory of one thread, and what it carries from row to row.
struct CensusCostScratch {
  /// Rows of both views taken apart into bytes: those of the window, and the one that comes next.
  Buffer<std::uint8_t> planes;
  /// Differing bits of the window's rows, for processors that are slow to count them once more when
  /// a row leaves the window; others never touch it.
  Buffer<std::uint8_t> kept;
  Buffer<std::uint8_t> sums;    ///< differing bits over the window's rows
  Buffer<std::uint8_t> tables;  ///< penalties below and above a range, and behind D

  void resize(int width, const CensusCostOptions& options);
};

/// Begins with row y: the rows y, y + 1 ... are then asked for in turn.
void start_census_costs(const CensusImage& left, const CensusImage& right,
                        const CensusCostOptions& options, int y, CensusCostScratch& scratch);

/// Writes the costs of row y, which is the one begun with or the one behind the last one: width *
/// lanes cells. Disparities outside low[x] .. high[x] cost the penalty more, unless low > high:
/// then nothing is known of the pixel. Sums end at 255.
void census_cost_row(const CensusImage& left, const CensusImage& right,
                     const CensusCostOptions& options, int y, const std::uint16_t* low,
                     const std::uint16_t* high, CensusCostScratch& scratch, std::uint8_t* costs);

}  // namespace mtstereo
