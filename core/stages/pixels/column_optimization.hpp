// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "stages/pixels/cost_lanes.hpp"

namespace mtstereo {

/// Paths of semi-global matching along the columns, for path_matching: the counterpart of
/// row_walk. A path goes from row to row, upwards or downwards, so that one call
/// advances the paths of all columns by one row.

/// The input of one row.
struct ColumnStep {
  const std::uint8_t* costs;        ///< of each pixel in its window
  const std::uint8_t* large_steps;  ///< from the paths' previous row, see find_large_steps()
  int width;
  int disparities;
  int small_step;                       ///< SmoothnessOptions
  const CostWindow* windows = nullptr;  ///< of the row's tiles; nullptr = all lanes
};

/// Advances the paths by one row: writes the path costs of its cells, as defined at
/// match_walked_rows(), from the costs of the previous row in the same windows. `before` may be
/// `paths`; it is nullptr in the paths' first row. `least` holds the least path cost of each
/// column, first of the previous row, then of this one.
void step_columns(const ColumnStep& row, const std::uint8_t* before, std::uint8_t* paths,
                  std::uint8_t* least);

/// Copies the path costs of a row in the windows `from` to other windows. Those of disparities in
/// `to` alone become 255, so that they are never the least.
void move_columns(const CostWindow* from, const CostWindow* to, int lanes, int width,
                  const std::uint8_t* paths, std::uint8_t* moved);

}  // namespace mtstereo
