// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "choices.hpp"

namespace mtstereo {

/// The first half of step 9 (paper, "guided pixel matching"): which disparities the nodes expect at
/// each pixel of a row.

struct SearchRangeOptions {
  double range;  ///< omega_omega: share of the disparity that is expected on both sides
  BetweenNodes between_nodes;
  int disparities;  ///< D: the disparities 0 .. D - 1 exist
};

/// Least distance that is expected on both sides of a disparity [px].
inline constexpr int kMinSearch = 3;

/// Writes for each pixel of a row the whole disparities low .. high that are expected there, given
/// the nodes' disparities in 1 / kDisparityOne px: from d * (1 - range) to d * (1 + range), both
/// included and at least kMinSearch px on both sides. low > high where none is.
void find_search_ranges(const std::int32_t* nodes, int width, const SearchRangeOptions& options,
                        std::uint16_t* low, std::uint16_t* high);

}  // namespace mtstereo
