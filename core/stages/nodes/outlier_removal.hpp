// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "base/limits.hpp"

namespace mtstereo {

/// The steps node-outliers and pixel-outliers (paper, "Disparity map" and "Confidence check and map
/// refinement"): removes disparities that disagree with most of their surroundings.

/// A copy of a disparity map in the form that the vote reads, with a border of `radius` pixels.
struct VoteMap {
  int radius = 0;
  /// Disparities in 1 / kVoteOne px; kVoteNone for pixels without one and in the border.
  Image<std::uint16_t> disparity;
  /// Integral image of the known disparities: for each pixel, the number of pixels with a disparity
  /// above and left of it. One column and one row more than the map.
  Image<std::uint32_t> integral;

  void resize(int width, int height, int window_radius);
};

/// Steps of a VoteMap's disparities per px. The largest disparity plus the window's width fit
/// into 16 bits.
inline constexpr int kVoteOne = 32;

/// The value of a VoteMap's pixel without a disparity, further than a window's radius from every
/// disparity.
inline constexpr std::uint16_t kVoteNone = 0xFFFF;
static_assert((kLargestMaxDisparity + 2 * kLargestOutlierRadius) * kVoteOne < kVoteNone);

/// Copies the rows y0 .. y1 - 1 of the map.
void copy_votes(const Image<std::int32_t>& map, int y0, int y1, VoteMap& votes);

/// Completes the columns x0 .. x1 - 1 of VoteMap::integral by vertical sums; copy_votes() has
/// written horizontal ones.
void sum_votes(int x0, int x1, VoteMap& votes);

/// Removes every outlier from the rows y0 .. y1 - 1 of `map`. In the window of columns x - radius
/// .. x + radius - 1 and rows y - radius .. y + radius - 1, a pixel with a disparity is an inlier
/// if that differs from the disparity at (x, y) by at most the pixel's horizontal distance [px]. A
/// disparity with more outliers than inliers is removed.
void remove_outliers(const VoteMap& votes, int y0, int y1, Image<std::int32_t>& map);

}  // namespace mtstereo
