// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "base/limits.hpp"

namespace mtstereo {

/// Steps 7 and 10 (paper, "Disparity map" and "Confidence check and map refinement"): removes
/// disparities that most of their surroundings contradict.

/// A copy of a disparity map in the form that the vote reads, with a border of `radius` pixels.
struct VoteMap {
  int radius = 0;
  /// Disparities in 1 / kVoteOne px; kVoteNone where there is none and in the border.
  Image<std::uint16_t> disparity;
  /// Number of pixels with a disparity above and left of each pixel; one column and row more.
  Image<std::uint32_t> integral;

  void resize(int width, int height, int window_radius);
};

/// Steps of a VoteMap's disparities per px: 1024 px and the window's radius fit 16 bits.
inline constexpr int kVoteOne = 32;

/// A VoteMap's pixel without a disparity; no disparity comes as near as a window's radius.
inline constexpr std::uint16_t kVoteNone = 0xFFFF;
static_assert((kLargestMaxDisparity + 2 * kLargestOutlierRadius) * kVoteOne < kVoteNone);

/// Copies the rows y0 .. y1 - 1 of the map.
void copy_votes(const Image<std::int32_t>& map, int y0, int y1, VoteMap& votes);

/// Sums up the columns x0 .. x1 - 1 of VoteMap::integral, whose rows are running sums after
/// copy_votes().
void sum_votes(int x0, int x1, VoteMap& votes);

/// Removes from the rows y0 .. y1 - 1 of `map` every disparity d for which, in the window of
/// columns x - radius .. x + radius - 1 and rows y - radius .. y + radius - 1, more pixels with a
/// disparity differ from d by more than their horizontal distance [px] than by at most that.
void remove_outliers(const VoteMap& votes, int y0, int y1, Image<std::int32_t>& map);

}  // namespace mtstereo
