// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>

#include "base/buffer.hpp"
#include "stages/pixels/cost_lanes.hpp"

namespace mtstereo {

/// The part of guided pixel matching that smooths the disparities along the row: two paths of
/// semi-global matching, from the left and from the right.
///
/// Both paths start at the same time, each at its end of the row, and meet in the middle. Up to the
/// middle they store their costs. From there on each path reads the other's costs of the same
/// pixel, so that the sums are available in blocks of pixels that are still in the cache, and no
/// row of sums has to be stored.

struct SmoothnessOptions {
  int small_step;  ///< P1: cost of a step of one disparity from pixel to pixel
  int large_step;  ///< P2: cost of a larger step between equal gray values; 0 = no optimization
};

/// P2 by the change of the gray value: large_step * 8 / (8 + change), at least small_step.
using LargeStepTable = std::array<std::uint8_t, 256>;
LargeStepTable large_step_table(const SmoothnessOptions& options);

/// The path costs of a row along its columns, from above and from below: cells as those of
/// ScanlineRow::costs; or nullptr.
struct ColumnCosts {
  const std::uint8_t* from_above = nullptr;
  const std::uint8_t* from_below = nullptr;
};

/// The input of one row.
struct ScanlineRow {
  const std::uint8_t* costs;  ///< cell [x][d] at x * cost_lanes(disparities) + d
  const std::uint8_t* gray;   ///< of the left view
  int width;
  int disparities;
  int small_step;
  const LargeStepTable* large_step;
  ColumnCosts columns = {};
  const CostWindow* windows = nullptr;  ///< of the row's tiles; nullptr = all lanes
};

/// Pixels of a block.
inline constexpr int kScanlineBlock = 16;

/// The sums of both paths' costs of the columns begin .. end - 1, at (x - begin) * lanes + d. With
/// ScanlineRow::columns they are half the sums of four paths, rounded down: as large as those of
/// two.
struct ScanlineSums {
  int begin;
  int end;
  const std::uint16_t* sums;
};

/// Scratch memory of one thread, and its state between blocks.
struct ScanlineScratch {
  Buffer<std::uint8_t> paths;   ///< per pixel: the costs of the path that reached it first
  Buffer<std::uint8_t> ends;    ///< the costs of each path's last two pixels
  Buffer<std::uint16_t> sums;   ///< of two blocks
  std::array<int, 2> least{};   ///< per path: the least cost of its last pixel
  std::array<int, 2> newest{};  ///< per path: which of the two pixels in `ends` is its last one

  void resize(int width, int disparities);
};

/// Number of blocks. scanline_block() has to be called for 0 .. count - 1, in this order.
int scanline_blocks(int width);

/// Follows both paths from their ends to the middle. The path cost of a cell is its cost, plus the
/// least sum of a path cost of the previous pixel and the cost of the step from there, minus the
/// least path cost of the previous pixel; it saturates at 255. A step of 0 or 1 disparities comes
/// from a disparity that is in the windows of both pixels, a larger one from any.
void start_scanline(const ScanlineRow& row, ScanlineScratch& scratch);

/// The sums of the next columns of both paths, the path from the left first. Either may have no
/// columns. Valid until the next call.
std::array<ScanlineSums, 2> scanline_block(const ScanlineRow& row, int block,
                                           ScanlineScratch& scratch);

}  // namespace mtstereo
