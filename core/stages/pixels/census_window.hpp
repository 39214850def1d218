// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#include "stages/pixels/cost_lanes.hpp"
#include "stages/prepare/census.hpp"

/// Internal to census_cost.cpp: the types that the kernels of all SIMD targets share.

namespace mtstereo {

/// One row of both views, one plane per byte of the census transform. The right row is mirrored,
/// and its last value repeats for cost_lanes() further columns.
struct CensusRow {
  std::uint8_t* left[kCensusBytes];
  std::uint8_t* right[kCensusBytes];
};

/// Columns whose sums are stored: a tile and its surroundings, a power of 2.
inline constexpr int kSummedColumns = 2 * kWindowTile;

/// Rows whose costs are written at once, and which enter the window.
inline constexpr int kPairedRows = 2;

/// The names are those of rows that follow each other downwards; upwards they are reversed.

/// The differing bits of two rows that entered together, cell [x][d] at x * lanes + d.
struct PairCounts {
  std::uint8_t* both;   ///< of both rows
  std::uint8_t* lower;  ///< of the second row
};

/// The windows of two successive rows.
struct CensusWindow {
  int width;
  int lanes;                   ///< cost_lanes()
  CensusRow in[kPairedRows];   ///< the rows that enter the windows
  PairCounts first;            ///< the first pair of rows, which the entering one replaces
  const std::uint8_t* middle;  ///< of both rows of the second pair, in windows of 5 rows
  const CostWindow* matched;   ///< the windows of the rows whose costs are written
  const CostWindow* counted;   ///< windows that cover all rows that the entering ones concern
  std::uint8_t* sums;          ///< [column][row of the pair][disparity]

  /// The sums of column x, those of the pair's first row before those of the second.
  std::uint8_t* sums_of(int x) const {
    return sums + static_cast<std::ptrdiff_t>(x & (kSummedColumns - 1)) * kPairedRows * lanes;
  }
};

/// The sums of the columns x - 2 .. x + 2.
struct ColumnSums {
  const std::uint8_t* of[5];
};

/// See CensusCostScratch::tables.
struct CensusTables {
  const std::uint8_t* below;
  const std::uint8_t* above;
  const std::uint8_t* never;
};

}  // namespace mtstereo
