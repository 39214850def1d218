// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "mtstereo/image.hpp"
#include "stages/refine/clues.hpp"

namespace mtstereo {

/// The clue of reliability.hpp about the map of half the matched resolution, which is rated as
/// well: how likely its disparity is right, and how far that is from the pixel's own. On soft,
/// noisy and compressed views it knows better than the full resolution what can be trusted.

/// The bin is kGuideDistances times the level of the guide's confidence, plus the number of ends up
/// to the distance between both disparities.
inline constexpr int kGuideDistances = 4;
inline constexpr int kGuideDistanceEnds[kGuideDistances - 1] = {
    kDisparityOne / 2, kDisparityOne, 3 * kDisparityOne};  // [1 / kDisparityOne px]

/// A level has this many steps of the confidence; the first one begins at kLeastGuideConfidence and
/// includes all lower ones, the last one all higher ones.
inline constexpr int kGuideLevels = 8;
inline constexpr int kGuideLevel = 24;
inline constexpr int kLeastGuideConfidence = 28;

/// Elements after a row of `expected` and `bins` that find_guide_bins() may write.
inline constexpr int kGuidePadding = 2 * static_cast<int>(kAlignment);

/// Finds the bins of row y of the map; all are 0 without a guide. `expected` is scratch memory for
/// a row.
void find_guide_bins(const RatedGuide& guide, const Image<std::int32_t>& map, int y,
                     std::int32_t* expected, std::uint8_t* bins);

}  // namespace mtstereo
