// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/buffer.hpp"
#include "stages/prepare/census.hpp"

namespace mtstereo {

/// Refines disparities that are right to about one pixel, as those of halved views are, by the
/// census costs of the full views.
///
/// All pixels of a window are shifted by the same amount -1 .. 1 px against their own disparities,
/// so that the window follows slants and edges. The shift with the least sum of costs, refined
/// between whole pixels, is what the window's disparities are off on average; what they were
/// rounded by for the costs is taken out of it. A shift away from the given disparities costs a
/// little, so that they are not lost where the costs tell little. The disparity stays where no
/// shift is a minimum.

/// Half the side of the window [px].
inline constexpr int kRefinementRadius = 3;

/// Scratch memory of one thread: the rows that the window covers, and their sums.
struct RefinementScratch {
  static constexpr int kShifts = 5;                        ///< -2 .. 2 px
  static constexpr int kRows = 2 * kRefinementRadius + 2;  ///< those of the window and one more
  /// So many numbers in front of the row in `right`: a vector that may be read.
  static constexpr int kBefore = kAlignment / sizeof(std::uint32_t);

  std::ptrdiff_t stride = 0;           ///< from row to row of all that have several [elements]
  Buffer<std::uint32_t> right;         ///< a row of the right view with its ends repeated
  Buffer<std::int32_t> places;         ///< of each pixel where its partner stands there
  Buffer<std::uint8_t> costs;          ///< kRows x kShifts rows [bits]
  Buffer<std::int8_t> rounded;         ///< kRows rows: what was rounded off [1/256 px]
  Buffer<std::uint8_t> known;          ///< kRows rows: 1 where there is a disparity
  Buffer<std::uint8_t> cost_columns;   ///< kShifts rows: sums over the window's rows
  Buffer<std::int16_t> round_columns;  ///< the same of `rounded`
  Buffer<std::uint8_t> known_columns;  ///< the same of `known`
  Buffer<std::int16_t> sums;           ///< kShifts + 2 rows: sums over the window

  /// The only one that allocates.
  void resize(int width);
};

/// Writes the rows y0 .. y1 - 1 of `refined`, an image as large as the map; reads kRefinementRadius
/// rows more of the others on both sides. In the map as in `refined` no disparity is above its
/// column; in `refined` all are below max_disparity [px]. The result does not depend on how the
/// image is cut into bands.
void refine_disparities(const CensusImage& left, const CensusImage& right,
                        const Image<std::int32_t>& map, int max_disparity, int y0, int y1,
                        RefinementScratch& scratch, Image<std::int32_t>& refined);

}  // namespace mtstereo
