// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "stages/nodes/node_pair.hpp"
#include "stages/prepare/census.hpp"

namespace mtstereo {

/// Part of the step node-matching (paper, "Matching cost aggregation"): the intensity cost of two
/// nodes without a cost volume. The volume's wide kernel supports a node by its surroundings; here
/// this support comes from the neighbors in the rows above and below, with which nodes are matched
/// together, and from the columns beside the node. Costs are computed only for pixel pairs that a
/// pair of nodes needs.

/// Additional columns on both sides of the left node.
inline constexpr int kNodeMargin = 5;

/// Cost of one differing bit [gray values].
inline constexpr int kBitCost = 3;

/// A pair of nodes whose pixels differ in this many bits or more is no match: different points of
/// the scene differ in half of the bits, the same point in few even if the views are noisy. [bits]
inline constexpr int kMostNodeBits = 7;

/// Mean number of differing bits, times kBitCost, over every second column of the left node of row
/// y and of kNodeMargin columns on both sides, beginning with the first of these. The disparity
/// changes linearly from the pair's begin disparity to its end disparity, both at least 0, and is
/// constant on either side of the node. Columns outside of either view are skipped.
float census_intensity_cost(const CensusImage& left, const CensusImage& right, int y,
                            const NodePair& pair);

}  // namespace mtstereo
