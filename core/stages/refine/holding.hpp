// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/image.hpp"

namespace mtstereo {

/// What the last pair of a stream decides about the map of the present one, where the left view is
/// still: a pixel that the last map knows needs less confidence if the present pair chose the same
/// disparity, and another one more. No disparity of the last map gets into the present one.

/// Side of the blocks of the view that are still or not [px].
inline constexpr int kStillBlock = 8;

/// A block is still if its pixels differ from those of the last view by at most kStillNoise times
/// the noise plus kStillOffset on average [gray values]. Noise alone makes 1.13 times as much.
inline constexpr float kStillNoise = 1.4F;
inline constexpr float kStillOffset = 1;

/// Steps of a disparity of the last map per px.
inline constexpr int kHeldOne = 32;

/// Disparities are the same if they differ by at most this [1 / kHeldOne px].
inline constexpr int kHeldTolerance = kHeldOne;

/// The least confidence of a pixel.
struct LeastConfidence {
  std::uint8_t usual = 0;  ///< where the view is not still
  std::uint8_t known = 0;  ///< of a disparity that the last map has too
  std::uint8_t fresh = 0;  ///< of another one
};

/// Number of blocks for this many pixels.
inline constexpr int still_blocks(int pixels) { return (pixels + kStillBlock - 1) / kStillBlock; }

/// Finds the blocks of the rows y0 .. y1 - 1 that are still, with this standard deviation of the
/// noise, and returns their number. `still` has a pixel per block, which becomes 1 or 0; y0 is the
/// first row of a block.
int find_still(GrayView view, const Image<std::uint8_t>& last, float noise, int y0, int y1,
               Image<std::uint8_t>& still);

/// The same blocks in views that are `scale` times smaller and begin `column` pixels further right,
/// or further left if negative: a block is still if all are that it shows.
void place_still(const Image<std::uint8_t>& still, int scale, int column,
                 Image<std::uint8_t>& placed);

/// The least confidence of each pixel of the rows y0 .. y1 - 1. The view is still at a pixel if its
/// block and the eight around are: what moves also changes the map beside it.
void choose_least(const LeastConfidence& least, const Image<std::uint8_t>& still,
                  const Image<std::uint16_t>& last, const Image<std::int32_t>& map, int y0, int y1,
                  Image<std::uint8_t>& chosen);

/// Removes the disparities of the rows y0 .. y1 - 1 whose confidence is below the least of the
/// pixel.
void threshold_each(const Image<std::uint8_t>& least, int y0, int y1, Image<std::int32_t>& map,
                    Image<std::uint8_t>& confidence);

/// Copies the rows y0 .. y1 - 1 of a map, to be the last one of the next pair.
void copy_last(const Image<std::int32_t>& map, int y0, int y1, Image<std::uint16_t>& last);

}  // namespace mtstereo
