// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <limits>

#include "mtstereo/parameters.hpp"
#include "stages/pixels/disparity_selection.hpp"

/// Internal to disparity_selection.cpp: the limits of its kernels and of the words described at
/// SelectionScratch.

namespace mtstereo {

inline constexpr int kDisparityBits = 7;
inline constexpr int kMostGroups =
    (kLargestMaxDisparity + SelectionScratch::kGroup - 1) / SelectionScratch::kGroup;
static_assert(SelectionScratch::kGroup == 1 << kDisparityBits);
inline constexpr int kLowestWord = std::numeric_limits<std::int16_t>::min();
inline constexpr int kMostCost = (kCostLimit - 1) << kDisparityBits;
static_assert(kLowestWord + kMostCost + SelectionScratch::kGroup - 1 < SelectionScratch::kNone);

/// Pixels that are finished together, at most.
inline constexpr int kFinishedTogether = 8;

}  // namespace mtstereo
