// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/image.hpp"

namespace mtstereo {

/// Step 1 (paper, "Pre-processing"): what the Max-trees and the cost volume are made of.

/// One view after pre-processing. All images have the view's size.
struct PreprocessedView {
  /// The median-filtered gray values.
  Image<std::uint8_t> median;
  /// The quantized, inverted edge strength: 0 .. q - 1, high = little contrast.
  Image<std::uint8_t> level;
  /// Gray value, horizontal and vertical Sobel of the image that costs are made of, each times its
  /// weight in the cost (kCostWeights) and kCostScale, so that a cost is three absolute
  /// differences.
  Image<std::int16_t> gray;
  Image<std::int16_t> sobel_x;
  Image<std::int16_t> sobel_y;

  void resize(int width, int height);
};

/// Steps of the fixed-point costs per gray value.
inline constexpr int kCostScale = 16;

/// Weights of gray value, horizontal and vertical Sobel in the cost, times kCostScale and 256.
/// They are 0.30, 0.59 and 0.11.
inline constexpr std::array<int, 3> kCostWeights = {1229, 2417, 451};

/// Largest |Sobel x| + |Sobel y| of an 8-bit image.
inline constexpr int kLargestEdge = 2040;

/// Level of each |Sobel x| + |Sobel y|: the mean of the two, inverted, stretched such that
/// 125 becomes 0 and 255 stays, and quantized to q levels of equal width.
using LevelTable = std::array<std::uint8_t, kLargestEdge + 1>;
LevelTable level_table(int gray_levels);

/// Median 5x5 of the rows y0 .. y1 - 1; beyond the border the border's pixels are repeated.
/// `scratch` is resized to the band at the first use.
void median_rows(GrayView image, int y0, int y1, Image<std::uint8_t>& scratch,
                 Image<std::uint8_t>& median);

/// Sobel 3x3 (the image is mirrored at its border, without repeating the border) and the results
/// made of it, for the rows y0 .. y1 - 1: the levels from the median, and what the costs are made
/// of from `cost_image`, which is the median (the paper) or the view itself. Reads one row above
/// and below. `scratch` is resized to one row.
void gradient_rows(const LevelTable& levels, GrayView cost_image, int y0, int y1,
                   Buffer<std::int16_t>& scratch, PreprocessedView& view);

}  // namespace mtstereo
