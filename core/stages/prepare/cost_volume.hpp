// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "base/buffer.hpp"
#include "stages/prepare/preprocess.hpp"

namespace mtstereo {

/// The step cost-volume (paper, "Cost volume"): the smoothed matching cost of every left pixel at
/// every disparity.

/// The smoothed costs, in kCostScale steps per gray value. With shift 1 each cell covers 2 x 2
/// pixels: smoothing removes all finer detail. Cells without a right pixel (x < d) repeat the cost
/// of the first cell that has one.
struct CostVolume {
  int disparities = 0;          ///< D: slices 0 .. D - 1
  int shift = 0;                ///< log2 of a cell's side [px]
  int columns = 0;              ///< cells per row
  int rows = 0;                 ///< rows of cells
  std::ptrdiff_t stride = 0;    ///< from slice to slice [elements]
  Buffer<std::uint16_t> cells;  ///< [rows][disparities][stride]

  void resize(int width, int height, int disparity_count, int resolution_shift);
  /// The cells of pixel row y at disparity 0; those of disparity d follow at d * stride.
  const std::uint16_t* row(int y) const {
    return cells.data() + (y >> shift) * (disparities * stride);
  }
  std::uint16_t at(int x, int y, int d) const { return row(y)[d * stride + (x >> shift)]; }
};

/// One half of a symmetric smoothing kernel: the weights of the center and of the cells at
/// distances 1 .. n - 1, in 1 / 32768. The weights of the whole kernel add up to 32768, or to 32767
/// for a kernel of one cell.
using SmoothingKernel = std::vector<std::int16_t>;

/// The kernel, in cells, of a Gaussian of `size` px (odd) with the standard deviation
/// 0.3 ((size - 1) / 2 - 1) + 0.8 px. At half resolution the mean over 2 x 2 px accounts for a part
/// of it.
SmoothingKernel smoothing_kernel(int size, int shift);

/// Scratch memory of one thread.
struct CostScratch {
  Buffer<std::uint16_t> raw;
  Buffer<std::int16_t> reduced;
  Buffer<std::int16_t> ring;

  void resize(const CostVolume& volume, const SmoothingKernel& kernel);
};

/// Number of slices to compute together, such that their rows stay in the cache.
int slices_per_block(const CostVolume& volume, const SmoothingKernel& kernel);

/// Fills the slices d0 .. d1 - 1 of the volume; d1 - d0 is at most slices_per_block(). Smoothing
/// repeats the border's costs outside of the image.
void compute_cost_slices(const PreprocessedView& left, const PreprocessedView& right,
                         const SmoothingKernel& kernel, int d0, int d1, CostScratch& scratch,
                         CostVolume& volume);

}  // namespace mtstereo
