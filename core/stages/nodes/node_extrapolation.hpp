// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/parameters.hpp"
#include "stages/nodes/node_levels.hpp"
#include "stages/nodes/node_matching.hpp"

namespace mtstereo {

/// Step 8 (paper, "Disparity map", reliable node extrapolation): gives each leaf the disparities of
/// its surroundings.

/// Disparities at the ends of the leaves in 1 / kDisparityOne px, kNoDisparity where there is none;
/// laid out as the columns of NodeLevel.
struct LeafDisparities {
  Buffer<std::int32_t> begin;
  Buffer<std::int32_t> end;
  Buffer<std::uint8_t> given;  ///< 1 where extrapolate_leaves() has given the leaf disparities

  void resize(const NodeLevel& leaves);
};

/// Reads what the map holds at the ends of the leaves of the rows y0 .. y1 - 1.
void read_leaf_ends(const NodeLevel& leaves, const Image<std::int32_t>& map, int y0, int y1,
                    LeafDisparities& ends);

/// The same, where the map is what draw_matches() makes of the matches of the leaves.
void take_match_ends(const NodeLevel& leaves, const NodeMatches& matches, int y0, int y1,
                     LeafDisparities& ends);

/// Writes the rows y0 .. y1 - 1 of the map: each leaf takes the median begin and the median end
/// disparity of itself and its neighbors, linearly in between; kNoDisparity elsewhere.
/// `end_width` 0: along the whole leaf. Otherwise on that many pixels around each of its ends, see
/// keep_leaf_ends().
void extrapolate_leaves(const NodeLevel& leaves, int max_neighbors, int end_width, int y0, int y1,
                        LeafDisparities& ends, Image<std::int32_t>& map);

/// Sets all but `end_width` pixels (an odd number) around the ends of the leaves to kNoDisparity in
/// the rows y0 .. y1 - 1 of the map, and to 0 in those of `values`. The middle one of these
/// pixels is the leaf's first or last one, or 2 px inside where the leaf is wider than 4 px.
/// Only leaves that extrapolate_leaves() gives disparities to count. `marks` is one row.
void keep_leaf_ends(const NodeLevel& leaves, const LeafDisparities& ends, int end_width, int y0,
                    int y1, Buffer<std::uint8_t>& marks, Image<std::int32_t>& map,
                    Image<std::uint8_t>& values);

}  // namespace mtstereo
