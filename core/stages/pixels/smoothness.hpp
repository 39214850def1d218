// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

namespace mtstereo {

/// The penalties of paths of semi-global matching, in units of the costs.
struct SmoothnessOptions {
  int small_step;  ///< P1: cost of a step of one disparity from pixel to pixel
  int large_step;  ///< P2: cost of a larger step between equal gray values; 0 = no optimization
};

/// Writes P2 for the steps between pixels of two rows, by the change of the gray value:
/// large_step * 8 / (8 + change), at least small_step and at most 255.
void find_large_steps(const SmoothnessOptions& options, const std::uint8_t* gray,
                      const std::uint8_t* gray_before, int width, std::uint8_t* large_steps);

}  // namespace mtstereo
