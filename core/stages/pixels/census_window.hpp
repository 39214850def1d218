// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "stages/prepare/census.hpp"

/// Internal to census_cost.cpp: the types that the kernels of all SIMD targets share.

namespace mtstereo {

/// One row of both views, one plane per byte of the census transform. The right row is mirrored,
/// and its last value repeats for cost_lanes() further columns.
struct CensusRow {
  std::uint8_t* left[kCensusBytes];
  std::uint8_t* right[kCensusBytes];
};

/// The running sums over the window's rows.
struct CensusWindow {
  int width;
  int lanes;           ///< cost_lanes()
  CensusRow in;        ///< the row that enters the window
  CensusRow out;       ///< the row that leaves it
  std::uint8_t* kept;  ///< costs of the leaving row, replaced by those of the entering one
  std::uint8_t* sums;
};

/// See CensusCostScratch::tables.
struct CensusTables {
  const std::uint8_t* below;
  const std::uint8_t* above;
  const std::uint8_t* never;
};

}  // namespace mtstereo
