// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <iterator>

#include "stages/refine/clues.hpp"
#include "stages/refine/reliability_table.hpp"

/// Internal to reliability.cpp: the types that the kernels of all SIMD targets share.

namespace mtstereo {

/// The bin of the clues about other surfaces where there is none.
inline constexpr std::int16_t kNoSurface = 16;

/// The bins of the clue about the partner's column end at these columns: the bin of a column is the
/// number of ends up to it.
inline constexpr int kPartnerEnds[] = {-40, -20, -10, -5, 0, 3, 6, 10, 16, 24};

/// The bin of a sum of three rows of the clues about mismatch and texture is the number of ends up
/// to it.
using SummedRows = std::array<const std::uint8_t*, 3>;
inline constexpr std::int16_t kMismatchEnds[] = {3,  5,  7,  9,  14, 18,  23,  27,
                                                 36, 45, 54, 72, 90, 126, 180, 270};
inline constexpr std::int16_t kTextureEnds[] = {1,  3,   8,   14,  20,  27,  40,  54,
                                                75, 100, 135, 175, 230, 300, 400, 500};

/// The bin of the clue about mismatch of clipped pixels: their gray values agree without saying
/// anything.
inline constexpr std::uint8_t kClippedBin = 17;
static_assert(kClippedBin > std::size(kMismatchEnds) && kClippedBin < kClueBins);

/// A column of the table: the first bytes of the entries in memory, then the second ones.
struct EntryBytes {
  alignas(16) std::uint8_t of[2][kClueBins];
};

/// What the rating of a row reads.
struct RatedBins {
  const std::uint8_t* bins[kPixelClues];
  const EntryBytes* entries;  ///< per clue
  int same;                   ///< the sum of the entries that are the same for all pixels
  bool apart;                 ///< Inferred::kApart
};

/// The rows that the clues about other surfaces read; column x of the map is at x.
struct SurfaceRows {
  const std::int16_t* middle;
  const std::int16_t* above[kFartherDistances.size()];  ///< at these distances
  const std::int16_t* below[kFartherDistances.size()];
};

}  // namespace mtstereo
