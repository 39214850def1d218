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

/// With windows, columns whose sums are stored: a tile and its surroundings, a power of 2.
inline constexpr int kSummedColumns = 2 * kWindowTile;

/// The rows of the window.
struct CensusWindow {
  int width;
  int lanes;                  ///< cost_lanes()
  CensusRow in;               ///< the row that enters the window
  std::uint8_t* rows[5];      ///< differing bits of the entering row and those before it
  const CostWindow* matched;  ///< the windows of the row whose costs are written
  const CostWindow* counted;  ///< windows that cover all rows whose costs need the entering row
  std::uint8_t* sums;         ///< over the window's rows, see CensusCostScratch

  /// Without windows the sums are updated from row to row.
  bool running() const { return matched == nullptr; }
  std::uint8_t* sums_of(int x) const {
    return sums + static_cast<std::ptrdiff_t>(running() ? x : x & (kSummedColumns - 1)) * lanes;
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
