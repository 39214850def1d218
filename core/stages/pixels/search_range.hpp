// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

namespace mtstereo {

/// The first part of guided pixel matching (paper, "guided pixel matching"): the disparities that
/// the nodes expect at each pixel of a row.

struct SearchRangeOptions {
  double range;     ///< omega_omega: share of the disparity that is expected on both sides
  int disparities;  ///< D: the disparities 0 .. D - 1 exist
};

/// Smallest reach of a range on both sides of the node's disparity [px].
inline constexpr int kMinSearch = 3;

/// Writes for each pixel of a row the whole disparities low .. high that are expected there, given
/// the nodes' disparities d in 1 / kDisparityOne px: from d * (1 - range) to d * (1 + range), both
/// inclusive and at least kMinSearch px on both sides. low > high without a node: none is expected.
void find_search_ranges(const std::int32_t* nodes, int width, const SearchRangeOptions& options,
                        std::uint16_t* low, std::uint16_t* high);

}  // namespace mtstereo
