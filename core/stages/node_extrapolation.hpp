// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/parameters.hpp"
#include "stages/node_levels.hpp"

namespace mtstereo {

/// Step 8 (paper, "Disparity map", reliable node extrapolation): gives each leaf the disparities of
/// its surroundings.

/// Disparities at the ends of the leaves in 1 / kDisparityOne px, kNoDisparity where there is none;
/// laid out as the columns of NodeLevel.
struct LeafDisparities {
  Buffer<std::int32_t> begin;
  Buffer<std::int32_t> end;

  void resize(const NodeLevel& leaves);
};

/// Reads what the map holds at the ends of the leaves of the rows y0 .. y1 - 1.
void read_leaf_ends(const NodeLevel& leaves, const Image<std::int32_t>& map, int y0, int y1,
                    LeafDisparities& ends);

/// Writes the rows y0 .. y1 - 1 of the map: each leaf takes the median begin and the median end
/// disparity of itself and its neighbors. Sparse: at the leaf's ends, 2 px inside where it is wider
/// than 4 px. Semi-dense: linearly along the leaf. kNoDisparity elsewhere.
void extrapolate_leaves(const NodeLevel& leaves, const LeafDisparities& ends, int max_neighbors,
                        Mode mode, int y0, int y1, Image<std::int32_t>& map);

}  // namespace mtstereo
