// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "stages/pixels/cost_lanes.hpp"
#include "stages/pixels/disparity_selection.hpp"
#include "stages/pixels/smoothness.hpp"

namespace mtstereo {

/// The part of pixel matching that smooths the disparities along the row: two paths of semi-global
/// matching, from the left and from the right, and the disparity of least cost of each pixel.
///
/// Adjacent rows have the same windows, so that one walk advances the paths of several, and the
/// steps of one row hide the latency of the others'. The first walk goes from right to left and
/// stores the path costs. The second one goes from left to right and sums the costs of all paths of
/// a tile's pixels, then finds the best disparities of both views from the sums.

/// How the costs of a pixel's paths are averaged, in bytes, each time rounded up. They have the
/// range of two paths; the highest ones, of which bytes are 255, count as no disparity.
enum class PathSums {
  kTwo,   ///< of those along the row: mean(left, right)
  kFour,  ///< with those along the column: mean(mean(left, right), mean(above, below))
};

/// One of the rows. Costs are those of each pixel in its window; those of disparities that do not
/// exist are 255. Pixels with low > high have no expected range.
struct PathRow {
  const std::uint8_t* costs;
  const std::uint8_t* gray;        ///< of the left view
  const std::uint8_t* from_above;  ///< the costs of the paths along the columns, with kFour
  const std::uint8_t* from_below;
  const std::uint16_t* low;
  const std::uint16_t* high;
  Candidates* candidates;
};

/// Rows that are walked along together. A row of tiles has a multiple of it.
inline constexpr int kWalkedRows = 4;
static_assert(kWindowTile % kWalkedRows == 0);

struct WalkedRows {
  PathRow of[kWalkedRows];  ///< a row may repeat the one before it
  int width;
  SmoothnessOptions smoothness;
  const CostWindow* windows;  ///< of the rows' tiles; nullptr = all lanes
  PathSums sums;
};

/// Scratch memory of one thread.
struct RowWalkScratch {
  Buffer<std::uint8_t> paths;        ///< the path costs from the right of all rows
  Buffer<std::uint8_t> large_steps;  ///< per row and column: from the column before
  Buffer<std::uint8_t> ends;         ///< the path costs of the last pixel of each row
  Buffer<std::uint8_t> sums;         ///< of the rows' pixels in a tile, for sums_of()
  std::ptrdiff_t sums_stride;        ///< from row to row
  Buffer<std::uint8_t> limits;       ///< a third 0, then 255, then 0
  Buffer<std::uint8_t> beside;  ///< 255 at the best disparity and those next to it, 0 elsewhere

  void resize(int width, int disparities);

  /// The sums of a row in a tile: each pixel's in its window, then a vector of kNoSum, which
  /// is also before the first pixel.
  std::uint8_t* sums_of(int row) { return sums.data() + row * sums_stride + kCostStep; }
};

/// Finds the candidates of the rows: of equal costs the smallest disparity is the best. The
/// runner-up is the least cost of the disparities that differ from the best by more than 1.
///
/// The path costs of a pixel are its costs plus those of the cheapest step from the path's previous
/// pixel, minus the least path cost there; they saturate at 255. Steps come from the disparities in
/// the windows of both pixels, larger ones from the least of all.
void match_walked_rows(const WalkedRows& walked, const SelectionOptions& options,
                       RowWalkScratch& scratch);

/// The same for one of the rows by its costs alone, twice of which have the range of two paths.
void match_row_by_cost(const WalkedRows& walked, int row, const SelectionOptions& options,
                       RowWalkScratch& scratch);

}  // namespace mtstereo
