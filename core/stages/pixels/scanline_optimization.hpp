// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>

#include "base/buffer.hpp"

namespace mtstereo {

/// The part of guided pixel matching that lets the pixels of a row agree: two paths per row of
/// semi-global matching, from the left and from the right.
///
/// Both paths begin at once, each at its end, and meet in the middle. Until there their costs are
/// kept; from there on each finds the other's costs of the same pixel, so that the sums come out
/// in blocks of pixels that are still in the cache, and no row of sums is ever written.

struct SmoothnessOptions {
  int small_step;  ///< P1: cost of a step of one disparity from pixel to pixel
  int large_step;  ///< P2: cost of any larger step where the gray value stays; 0 = no optimization
};

/// P2 by the change of the gray value: large_step * 8 / (8 + change), not below small_step.
using LargeStepTable = std::array<std::uint8_t, 256>;
LargeStepTable large_step_table(const SmoothnessOptions& options);

/// One row to be optimized.
struct ScanlineRow {
  const std::uint8_t* costs;  ///< cell [x][d] at x * cost_lanes(disparities) + d
  const std::uint8_t* gray;   ///< of the left view
  int width;
  int disparities;
  int small_step;
  const LargeStepTable* large_step;
};

/// Pixels of a block.
inline constexpr int kScanlineBlock = 16;

/// The sums of both paths' costs of the columns begin .. end - 1, at (x - begin) * lanes + d.
struct ScanlineSums {
  int begin;
  int end;
  const std::uint16_t* sums;
};

/// Scratch memory of one thread, and what is carried from block to block.
struct ScanlineScratch {
  Buffer<std::uint8_t> paths;   ///< of each pixel the costs of the path that came there first
  Buffer<std::uint8_t> ends;    ///< the costs of each path's last two pixels, with margins
  Buffer<std::uint16_t> sums;   ///< of two blocks
  std::array<int, 2> least{};   ///< of each path the least cost of its last pixel
  std::array<int, 2> newest{};  ///< of each path which of the two pixels in `ends` is its last

  void resize(int width, int disparities);
};

/// Blocks that scanline_block() has to be called for: 0 .. count - 1, in this order.
int scanline_blocks(int width);

/// Both paths from their ends to the middle. The path cost of a cell is its cost plus the least of
/// the path's costs of the pixel before, with the steps' costs, less the least of all of them; it
/// ends at 255.
void start_scanline(const ScanlineRow& row, ScanlineScratch& scratch);

/// The sums of the next columns of both paths: those that the path from the left has come to, and
/// those that the path from the right has. Either may be none. Valid until the next call.
std::array<ScanlineSums, 2> scanline_block(const ScanlineRow& row, int block,
                                           ScanlineScratch& scratch);

}  // namespace mtstereo
