// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/image.hpp"

namespace mtstereo {

/// The noise of a view, for noise_filter: measured in the blocks with the least detail. Call
/// measure_blocks() for all bands of rows, then noise_level() once.

/// Side of a block [px].
inline constexpr int kNoiseBlock = 16;

/// Every second row of a block is measured.
inline constexpr int kNoiseRowStep = 2;

/// A block of which a part is saturated: it shows less noise than the view has.
inline constexpr std::uint32_t kSaturatedBlock = 0xFFFFFFFF;

/// Per block, row by row, the sum over its measured pixels of the magnitude of the 3x3 operator 1
/// -2 1 in both directions, which a slope or a straight edge along a row or column does not change;
/// or kSaturatedBlock. The blocks begin at pixel (1, 1) and are complete.
struct NoiseBlocks {
  int columns = 0;
  int rows = 0;
  Buffer<std::uint32_t> detail;
  Buffer<std::uint32_t> sorted;  ///< scratch memory of noise_level()

  void resize(int width, int height);
};

/// Measures the blocks whose row y satisfies y0 <= y * kNoiseBlock < y1.
void measure_blocks(GrayView view, int y0, int y1, NoiseBlocks& blocks);

/// The standard deviation of the noise [gray values]: that of white noise in the block at the lower
/// quartile of all blocks without saturation; 0 if there is none. Compressed views often have less
/// than any camera.
float noise_level(NoiseBlocks& blocks);

}  // namespace mtstereo
