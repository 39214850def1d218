// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/image.hpp"

namespace mtstereo {

/// What the gray values of the right view are in the left one: two cameras may have different
/// exposures and responses. The pixels that are matched at half the resolution say how they differ.

/// Every so many rows are read.
inline constexpr int kMappedRows = 8;

/// Gray values of the right view that share a median difference.
inline constexpr int kMappedGrays = 16;

/// Up to the first mean of these differences the views are alike, from the second on they are taken
/// as they are [gray values].
inline constexpr float kLeastMapped = 3;
inline constexpr float kFullyMapped = 6;

/// With fewer matched pixels than this, gray values stay as they are.
inline constexpr int kLeastMappedPixels = 256;

/// The gray value of the left view for each of the right one.
struct GrayMapping {
  bool is_identity = true;  ///< all stay as they are
  std::array<std::uint8_t, 256> left_of_right{};

  std::uint8_t of(std::uint8_t gray) const { return is_identity ? gray : left_of_right[gray]; }
};

/// The mapping from the pixels of the map that have a disparity. The views have its size.
GrayMapping find_gray_mapping(GrayView left, GrayView right, const Image<std::int32_t>& map);

/// Writes a row of the right view with the gray values of the left one.
void map_row(const std::uint8_t* right, int width, const GrayMapping& mapping, std::uint8_t* out);

}  // namespace mtstereo
