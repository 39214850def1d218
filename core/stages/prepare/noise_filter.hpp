// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/image.hpp"

namespace mtstereo {

/// The step noise-filter: a local Wiener filter (J.-S. Lee, "Digital image enhancement and noise
/// filtering by use of local statistics", 1980). Where the gray values of a window vary by much
/// more than the noise, the view keeps its detail; where they hardly vary, the mean of the
/// neighbors replaces it. noise_level.hpp measures the noise.

/// Side of the window whose variance determines how much is filtered [px].
inline constexpr int kNoiseWindow = 7;

/// The deviation below which the variation of a window counts as noise, for a noise level [gray
/// values]: three times the level, and more for views with less noise than a camera has, whose
/// fine detail a codec has removed or replaced.
float noise_threshold(float level);

/// The same for how clearly a view shows the blocks of its compression
/// (BlockBorders::visibility()): the filter removes the rest of what the codec added. 0 in views
/// without blocks.
float compression_threshold(double visibility);

/// Whether views with this noise [gray values] are filtered before they are matched along paths.
/// These need fine texture more than nodes do; so only noise and compression are worth the filter.
inline bool paths_need_filter(float level) {
  constexpr float kLeastNoise = 1.5F;
  constexpr float kMostOfCompressed = 0.25F;
  return level >= kLeastNoise || level < kMostOfCompressed;
}

/// Scratch memory of one thread.
struct NoiseFilterScratch {
  Image<std::uint8_t> view;       ///< the rows of a band with their borders
  Buffer<std::uint16_t> narrow;   ///< a row's columns, filtered by weights 1 6 1,
  Buffer<std::uint16_t> wide;     ///< and by weights 1 4 6 4 1
  Buffer<std::uint16_t> sums;     ///< of the window's columns,
  Buffer<std::int32_t> squares;   ///< and of their squares
  Buffer<std::uint8_t> no_row;    ///< zeros
  Buffer<std::uint16_t> columns;  ///< of smooth_lightly()

  /// For bands of up to `rows` rows of views of up to this width.
  void resize(int width, int rows);
};

/// Writes the rows y0 .. y1 - 1: w n + (1 - w) m, where n and m are the view filtered by weights
/// 1 6 1 and by 1 4 6 4 1 in both directions, and w = v / (v + threshold^2) in steps of 1 / 256
/// with the variance v of the window. The border's pixels are repeated outside of the image.
/// `scratch` is resized if it is too small for the band.
void filter_noise(GrayView view, float threshold, int y0, int y1, NoiseFilterScratch& scratch,
                  Image<std::uint8_t>& filtered);

/// The same with a threshold of 0: the weights 1 6 1 alone. Paths that run along the rows only need
/// that much in every view, since no other rows average the noise. `scratch` is resized if it is
/// too small for the width.
void smooth_lightly(GrayView view, int y0, int y1, NoiseFilterScratch& scratch,
                    Image<std::uint8_t>& filtered);

}  // namespace mtstereo
