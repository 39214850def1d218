// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/image.hpp"

namespace mtstereo {

/// The step preprocessing (paper, "Pre-processing"): the input of the Max-trees and of the cost
/// volume.

/// One view after pre-processing. All images have the view's size.
struct PreprocessedView {
  /// The gray values after the median filter (median_filter.hpp).
  Image<std::uint8_t> median;
  /// The quantized, inverted edge strength: 0 .. q - 1; high levels mean little contrast.
  Image<std::uint8_t> level;
  /// Gray value, horizontal and vertical Sobel of the image from which costs are computed, each
  /// multiplied by its weight in the cost (kCostWeights) and by kCostScale, so that a cost is the
  /// sum of three absolute differences.
  Image<std::int16_t> gray;
  Image<std::int16_t> sobel_x;
  Image<std::int16_t> sobel_y;

  /// Resizes `median` and `level`.
  void resize(int width, int height);
  /// Resizes the other three, which only a cost volume needs.
  void resize_costs(int width, int height);
};

/// Steps of the fixed-point costs per gray value.
inline constexpr int kCostScale = 16;

/// Weights of gray value, horizontal and vertical Sobel in the cost: 0.30, 0.59 and 0.11, times
/// kCostScale and 256.
inline constexpr std::array<int, 3> kCostWeights = {1229, 2417, 451};

/// Scratch memory of one thread: column sums of a row.
struct SobelScratch {
  Buffer<std::int16_t> smooth;
  Buffer<std::int16_t> difference;

  void resize(int width);
};

/// Both functions apply the 3x3 Sobel operators in the rows y0 .. y1 - 1 and read one row above and
/// below. At its border the image is mirrored without repeating the border. `scratch` is resized if
/// it is too small.

/// Writes the levels of the median: the mean of |Sobel x| and |Sobel y|, inverted, stretched such
/// that 125 becomes 0 and 255 stays, and quantized to q = `gray_levels` levels (2 .. 256) of equal
/// width.
void level_rows(int gray_levels, int y0, int y1, SobelScratch& scratch, PreprocessedView& view);

/// Writes the cost's input, computed from `image`: the median (the paper) or the view itself.
void cost_rows(GrayView image, int y0, int y1, SobelScratch& scratch, PreprocessedView& view);

}  // namespace mtstereo
