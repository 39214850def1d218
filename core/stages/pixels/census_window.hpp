// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#include "stages/pixels/cost_lanes.hpp"
#include "stages/prepare/census.hpp"

/// Internal to census_cost.cpp: the types that the kernels of all SIMD targets share.

namespace mtstereo {

/// One row of both views.
struct CensusRow {
  const std::uint8_t* left;  ///< the bytes of CensusImage
  /// One plane per byte of the census transform, mirrored. The last value repeats for cost_lanes()
  /// further columns.
  std::uint8_t* right[kCensusBytes];
};

/// The gray values of a row.
struct GrayRow {
  const std::uint8_t* left;   ///< as bright as the right view
  const std::uint8_t* right;  ///< mirrored, like CensusRow::right
};

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
  GrayRow gray[kPairedRows];   ///< of the rows whose costs are written; nullptr: without their cost
  std::uint8_t* sums;  ///< of a tile's columns and those that its costs need: [column][row][d]
};

/// What disparities cost beside the differing bits.
struct ExpectedCosts {
  const std::uint16_t* low;  ///< of the expected disparities, per column
  const std::uint16_t* high;
  const std::uint8_t* below;  ///< see CensusCostScratch::tables
  const std::uint8_t* above;
};

}  // namespace mtstereo
