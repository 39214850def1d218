// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/parameters.hpp"
#include "stages/nodes/node_levels.hpp"
#include "stages/nodes/node_matching.hpp"

namespace mtstereo {

/// The step node-drawing (paper, "Disparity map"): the disparity map of the matched leaves.

/// The value that column x of a map stores for a disparity, both in 1 / kDisparityOne px. A point
/// at infinity is stored as the smallest step above kNoDisparity. A disparity larger than x has no
/// right pixel and becomes kNoDisparity.
inline std::int32_t drawn_disparity(int x, std::int32_t disparity) {
  const std::int32_t shown = std::max(disparity, 1);
  return shown <= x * kDisparityOne ? shown : kNoDisparity;
}

/// Draws one node into a row of a map: linearly from `at_begin` at column `begin` to `at_end` at
/// column `end`, all disparities in 1 / kDisparityOne px. Pixels for which drawn_disparity()
/// returns kNoDisparity keep their value.
void draw_node(int begin, int end, std::int32_t at_begin, std::int32_t at_end, std::int32_t* row);

/// Writes the rows y0 .. y1 - 1 of the map: the matched nodes, kNoDisparity elsewhere.
void draw_matches(const NodeLevel& left, const NodeMatches& matches, int y0, int y1,
                  Image<std::int32_t>& map);

}  // namespace mtstereo
