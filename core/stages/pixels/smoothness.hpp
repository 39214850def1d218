// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace mtstereo {

/// The penalties of paths of semi-global matching, in units of the costs.
struct SmoothnessOptions {
  int small_step;  ///< P1: cost of a step of one disparity from pixel to pixel
  int large_step;  ///< P2: cost of a larger step between equal gray values; 0 = no optimization
};

/// P2 by the change of the gray value: large_step * 8 / (8 + change), at least small_step.
using LargeStepTable = std::array<std::uint8_t, 256>;
inline LargeStepTable large_step_table(const SmoothnessOptions& options) {
  LargeStepTable table{};
  for (int change = 0; change < 256; ++change) {
    const int cost = std::max(options.large_step * 8 / (8 + change), options.small_step);
    table[change] = static_cast<std::uint8_t>(std::min(options.large_step == 0 ? 0 : cost, 255));
  }
  return table;
}

}  // namespace mtstereo
