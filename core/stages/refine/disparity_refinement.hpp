// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/buffer.hpp"
#include "stages/prepare/census.hpp"

namespace mtstereo {

/// Refines the disparities of halved views, whose errors are about one pixel of the full views, by
/// the census costs of every other row of these.
///
/// All pixels of a window are shifted by the same amount -1 .. 1 px of the full views from their
/// own disparities, so that the window follows slants and edges. The shift with the least sum of
/// costs, interpolated between whole pixels, is the mean error of the window's disparities; the
/// mean rounding error of the disparities for which costs were computed is subtracted from it. A
/// shift away from the given disparities has a small cost, so that these are kept where the image
/// has little texture. A disparity is not changed if no shift is a minimum.

/// Radius of the window, without its middle pixel [px of the halved views].
inline constexpr int kRefinementRadius = 2;

/// Scratch memory of one thread: the rows that the window covers, and their sums.
struct RefinementScratch {
  static constexpr int kShifts = 5;                        ///< -2 .. 2 px
  static constexpr int kRows = 2 * kRefinementRadius + 2;  ///< those of the window and one more

  std::ptrdiff_t stride = 0;           ///< from row to row of all buffers with rows [elements]
  Buffer<std::uint32_t> left;          ///< a row of the left view, its last pixel repeated
  Buffer<std::uint32_t> right;         ///< a row of the right view with its ends repeated
  Buffer<std::int32_t> places;         ///< per pixel of the map: its partner's column there
  Buffer<std::uint32_t> partners;      ///< kShifts + 1 rows: the words from there on
  Buffer<std::uint8_t> costs;          ///< kRows x kShifts rows [bits]
  Buffer<std::int8_t> rounded;         ///< kRows rows: rounding errors [1/128 px]
  Buffer<std::uint8_t> known;          ///< kRows rows: 1 for a pixel with a disparity
  Buffer<std::uint8_t> cost_columns;   ///< kShifts rows: sums over the window's rows
  Buffer<std::int16_t> round_columns;  ///< the same of `rounded`
  Buffer<std::uint8_t> known_columns;  ///< the same of `known`
  Buffer<std::int16_t> sums;           ///< kShifts + 2 rows: sums over the window

  /// For maps of up to this width. The only function that allocates.
  void resize(int width);
};

/// Writes the rows y0 .. y1 - 1 of `refined`, which has the size of the map; reads
/// kRefinementRadius further rows of the other images on both sides. `left` and `right` have every
/// other row of the full views' transforms. A disparity that exceeds its column has no partner and
/// is not raised; the others stay below their columns, and all below max_disparity [px of the full
/// views]. The result does not depend on how the image is divided into bands.
void refine_disparities(const CensusImage& left, const CensusImage& right,
                        const Image<std::int32_t>& map, int max_disparity, int y0, int y1,
                        RefinementScratch& scratch, Image<std::int32_t>& refined);

}  // namespace mtstereo
