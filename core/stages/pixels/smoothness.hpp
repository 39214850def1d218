// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

namespace mtstereo {

/// The unit of SmoothnessOptions::edge is this part of a gray value.
inline constexpr int kEdgeParts = 8;

/// The change of the gray value that counts as an edge in views of usual contrast.
inline constexpr int kUsualEdge = 4 * kEdgeParts;

/// The penalties of paths of semi-global matching, in units of the costs.
struct SmoothnessOptions {
  int small_step;  ///< P1: cost of a step of one disparity from pixel to pixel
  int large_step;  ///< P2: cost of a larger step between equal gray values; 0 = no optimization
  int edge = kUsualEdge;  ///< the change of the gray value that halves P2 [1 / kEdgeParts]
};

/// SmoothnessOptions::edge for a view whose gray values have this range (GrayHistogram::range()):
/// less than usual in a view of a dark scene, where all edges are smaller.
int edge_for_range(int range);

/// Writes P2 for the steps between pixels of two rows, by the change of the gray value:
/// large_step * edge / (edge + change), at least small_step and at most 255.
void find_large_steps(const SmoothnessOptions& options, const std::uint8_t* gray,
                      const std::uint8_t* gray_before, int width, std::uint8_t* large_steps);

}  // namespace mtstereo
