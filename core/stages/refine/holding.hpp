// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/image.hpp"
#include "mtstereo/parameters.hpp"
#include "stages/prepare/camera_motion.hpp"

namespace mtstereo {

/// What the last pair of a stream decides about the map of the present one, where the motion of the
/// camera is known: a pixel needs less confidence if the last map has the same point of the scene,
/// and more if the last map knows nothing there. Beside a nearer surface it needs no more: there
/// the camera uncovers what the last map cannot know. No disparity of the last map gets into the
/// present one.

/// Disparities are the same if they differ by at most this [1 / kHeldOne px].
inline constexpr int kHeldTolerance = kHeldOne;

/// A pixel is beside a nearer surface if the disparity at this distance, to the left, to the right,
/// above or below, is larger by more than kHeldJump [1 / kDisparityOne px].
inline constexpr int kHeldJumpReach = 4;  // [px]
inline constexpr int kHeldJump = 2 * kDisparityOne;

/// The least confidence of a pixel.
struct LeastConfidence {
  std::uint8_t usual = 0;  ///< where the last map has another point of the scene, or ends
  std::uint8_t known = 0;  ///< of a point that the last map has too
  std::uint8_t fresh = 0;  ///< where the last map knows nothing, but not beside a nearer surface
};

/// Where some pixels of a row were in the last map.
struct HeldPlaces {
  static constexpr int kMost = 256;
  static constexpr std::int32_t kOutside = -1;
  int count = 0;
  alignas(kAlignment) std::array<std::int32_t, kMost> column;     ///< in the row
  alignas(kAlignment) std::array<std::int32_t, kMost> disparity;  ///< there [1 / kDisparityOne px]
  alignas(kAlignment) std::array<std::int32_t, kMost> index;  ///< from its first pixel, or kOutside
  alignas(kAlignment) std::array<std::int32_t, kMost> expected;  ///< there [1 / kHeldOne px]
};

/// Sets the confidences of the rows y0 .. y1 - 1 that are below the least of their pixel to 0,
/// except those below the lowest one in `least`, which stay. `map` is complete; `offset` is what a
/// disparity of 0 px of the maps stands for [px].
void doubt_by_last(const LeastConfidence& least, const CameraMotion& motion, float offset,
                   const Image<std::uint16_t>& last, const Image<std::int32_t>& map, int y0, int y1,
                   Image<std::uint8_t>& confidence);

/// Copies the rows y0 .. y1 - 1 of a map, to be the last one of the next pair.
void copy_last(const Image<std::int32_t>& map, int y0, int y1, Image<std::uint16_t>& last);

}  // namespace mtstereo
