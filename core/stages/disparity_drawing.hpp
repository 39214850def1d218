// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "stages/node_levels.hpp"
#include "stages/node_matching.hpp"

namespace mtstereo {

/// Step 6 (paper, "Disparity map"): the disparity map of the matched leaves.

/// Draws one node into a row of a map: linearly from `at_begin` at column `begin` to `at_end` at
/// column `end`, all disparities in 1 / kDisparityOne px. Pixels left of their disparity stay as
/// they are: no right pixel is there for them.
void draw_node(int begin, int end, std::int32_t at_begin, std::int32_t at_end, std::int32_t* row);

/// Writes the rows y0 .. y1 - 1 of the map: the matched nodes, kNoDisparity elsewhere.
void draw_matches(const NodeLevel& left, const NodeMatches& matches, int y0, int y1,
                  Image<std::int32_t>& map);

}  // namespace mtstereo
