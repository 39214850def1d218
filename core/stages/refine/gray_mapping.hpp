// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>

#include "mtstereo/image.hpp"
#include "stages/refine/clues.hpp"

namespace mtstereo {

/// What the gray values of the right view are in the left one, for the clue about their difference:
/// two cameras may have different exposures and responses. The matched pixels say how they differ.

/// Every so many rows are read.
inline constexpr int kMappedRows = 16;

/// Gray values of the right view that share a mean difference.
inline constexpr int kMappedGrays = 16;

/// A mean difference up to the first is noise and is ignored, from the second on it is taken as it
/// is [gray values].
inline constexpr float kLeastMapped = 3;
inline constexpr float kFullyMapped = 6;

/// With fewer matched pixels than this, gray values stay as they are.
inline constexpr int kLeastMappedPixels = 256;

/// The mapping from the pixels of the map that are matched, with a confidence above kMostInferred.
GrayMapping find_gray_mapping(const RatedViews& views, const Image<std::int32_t>& map,
                              const Image<std::uint8_t>& confidence);

}  // namespace mtstereo
