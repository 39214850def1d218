// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>

#include "base/buffer.hpp"

namespace mtstereo {

/// Smooths the costs of guided pixel matching along the scan-line, from both ends: a pixel's
/// neighbors draw it to their disparity, the less so the more the gray value changes between them.

struct SmoothnessOptions {
  int small_step;  ///< P1: cost of a step of one disparity between neighbors
  int large_step;  ///< P2: cost of any larger step, where the gray value stays
};

/// P2 for each difference of gray values between neighbors: P2 * 8 / (8 + difference), at least P1
/// and at most 255.
using LargeStepTable = std::array<std::uint8_t, 256>;
LargeStepTable large_step_table(const SmoothnessOptions& options);

/// Scratch memory of one thread.
struct ScanlineScratch {
  Buffer<std::uint8_t> forward;  ///< path costs of a row from its left end
  Buffer<std::uint8_t> path;     ///< the path costs of a pixel and of the one before

  void resize(int width, int disparities);
};

/// Writes the sums of the two paths' costs of a row: cell [x][d] at x * lanes + d as in `costs`,
/// see cost_lanes(). The cost of a path at a pixel is the pixel's cost plus the least of the path's
/// costs at the pixel before with the steps' costs added, less the least without; it ends at 255.
/// With P1 = P2 = 0 it is the pixel's cost.
void optimize_scanline(const std::uint8_t* costs, const std::uint8_t* gray, int width,
                       int disparities, int small_step, const LargeStepTable& large_step,
                       ScanlineScratch& scratch, std::uint16_t* sums);

}  // namespace mtstereo
