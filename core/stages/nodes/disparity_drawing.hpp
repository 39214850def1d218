// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/parameters.hpp"
#include "stages/nodes/node_levels.hpp"
#include "stages/nodes/node_matching.hpp"

namespace mtstereo {

/// Step 6 (paper, "Disparity map"): the disparity map of the matched leaves.

/// What column x shows of a disparity in 1 / kDisparityOne px: a point at infinity is told apart
/// from no disparity by the smallest step, and left of its disparity there is none, since no right
/// pixel is there.
inline std::int32_t drawn_disparity(int x, std::int32_t disparity) {
  const std::int32_t shown = std::max(disparity, 1);
  return shown <= x * kDisparityOne ? shown : kNoDisparity;
}

/// Draws one node into a row of a map: linearly from `at_begin` at column `begin` to `at_end` at
/// column `end`, all disparities in 1 / kDisparityOne px. Pixels that show none, see
/// drawn_disparity(), stay as they are.
void draw_node(int begin, int end, std::int32_t at_begin, std::int32_t at_end, std::int32_t* row);

/// Writes the rows y0 .. y1 - 1 of the map: the matched nodes, kNoDisparity elsewhere.
void draw_matches(const NodeLevel& left, const NodeMatches& matches, int y0, int y1,
                  Image<std::int32_t>& map);

}  // namespace mtstereo
