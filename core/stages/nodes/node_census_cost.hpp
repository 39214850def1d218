// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "stages/nodes/node_pair.hpp"
#include "stages/prepare/census.hpp"

namespace mtstereo {

/// Part of step 5 (paper, "Matching cost aggregation"): the intensity cost of two nodes without a
/// cost volume. What the volume's wide kernel gathers around a node comes here from the rows above
/// and below, with which nodes are matched together, and from the columns beside the node. Nothing
/// is computed for pairs of pixels that no pair of nodes asks for.

/// Columns on both sides of the left node that count as well.
inline constexpr int kNodeMargin = 5;

/// Gray values that one differing bit stands for.
inline constexpr int kBitCost = 4;

/// Mean number of bits that differ, times kBitCost, over every second column of the left node of
/// row y from kNodeMargin columns before it on. The disparity goes linearly from the pair's begin
/// disparity to its end disparity, both at least 0, and stays what it is there on the node's sides.
/// Columns that the one or the other view does not have do not count.
float census_intensity_cost(const CensusImage& left, const CensusImage& right, int y,
                            const NodePair& pair);

}  // namespace mtstereo
