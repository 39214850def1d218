// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/parameters.hpp"
#include "stages/nodes/node_levels.hpp"
#include "stages/nodes/node_matching.hpp"

namespace mtstereo {

/// The step node-extrapolation (paper, "Disparity map", reliable node extrapolation): assigns to
/// each leaf the disparities of its surroundings.

/// Disparities at the ends of the leaves in 1 / kDisparityOne px, or kNoDisparity. The arrays have
/// the layout of NodeLevel's per-node arrays.
struct LeafDisparities {
  Buffer<std::int32_t> begin;
  Buffer<std::int32_t> end;

  void resize(const NodeLevel& leaves);
};

/// Reads the map at the ends of the leaves of the rows y0 .. y1 - 1.
void read_leaf_ends(const NodeLevel& leaves, const Image<std::int32_t>& map, int y0, int y1,
                    LeafDisparities& ends);

/// Same result as read_leaf_ends() for the map that draw_matches() draws of the leaves' matches.
void take_match_ends(const NodeLevel& leaves, const NodeMatches& matches, int y0, int y1,
                     LeafDisparities& ends);

/// Writes the rows y0 .. y1 - 1 of the map. Each leaf takes the median begin disparity and the
/// median end disparity of itself and its neighbors, linearly interpolated; other pixels become
/// kNoDisparity. With `end_width` 0 the whole leaf is drawn, otherwise that many pixels (an odd
/// number) around each of its ends: the middle one is the leaf's first or last pixel; if the leaf
/// is wider than 4 px, it lies 2 px further inside.
void extrapolate_leaves(const NodeLevel& leaves, int max_neighbors, int end_width, int y0, int y1,
                        LeafDisparities& ends, Image<std::int32_t>& map);

}  // namespace mtstereo
