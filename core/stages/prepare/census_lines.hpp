// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

/// Internal to census.cpp: what the kernels of all SIMD targets share.

namespace mtstereo {

/// The largest distance of a neighbor [px].
inline constexpr int kCensusReach = 4;

/// The places of a byte's neighbors, relative to the pixel.
struct CensusNeighbors {
  int rows[8];
  int columns[8];
};

/// The neighbors at a distance in each of the eight directions.
constexpr CensusNeighbors census_directions(int distance) {
  CensusNeighbors neighbors{{-1, -1, -1, 0, 0, 1, 1, 1}, {-1, 0, 1, -1, 1, -1, 0, 1}};
  for (int i = 0; i < 8; ++i) {
    neighbors.rows[i] *= distance;
    neighbors.columns[i] *= distance;
  }
  return neighbors;
}

inline constexpr CensusNeighbors kNear = census_directions(1);
inline constexpr CensusNeighbors kFar = census_directions(2);
inline constexpr CensusNeighbors kCoarse = census_directions(kCensusReach);
/// The pixels of the 5x5 window between those directions.
inline constexpr CensusNeighbors kBetween = {{-2, -2, -1, -1, 1, 1, 2, 2},
                                             {-1, 1, -2, 2, -2, 2, -1, 1}};

/// The rows from kCensusReach above to kCensusReach below a row, beginning kCensusReach columns to
/// the left of it.
struct CensusLines {
  const std::int8_t* const* view;
  const std::int8_t* const* smoothed;  ///< nullptr for one scale
};

}  // namespace mtstereo
