// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#include "stages/pixels/cost_lanes.hpp"
#include "stages/pixels/disparity_selection.hpp"

/// Internal to row_walk.cpp: what the kernels of all SIMD targets read and write of a row. Pointers
/// instead of buffers: the compiler knows that no store of bytes changes them.

namespace mtstereo {

struct RowSelection {
  int width;
  int lanes;
  const std::uint16_t* low;  ///< of the disparities that can be runner-up; nullptr = all
  const std::uint16_t* high;
  const std::uint8_t* limits;  ///< RowWalkScratch::limits
  const std::uint8_t* beside;  ///< the middle of RowWalkScratch::beside
  std::int16_t* best;          ///< Candidates
  std::uint8_t* sums;
  std::uint8_t* right;
  std::ptrdiff_t right_stride;
  bool high_planes;  ///< whether disparities exceed a byte
};

}  // namespace mtstereo
