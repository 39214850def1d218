// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "stages/pixels/cost_lanes.hpp"
#include "stages/pixels/gray_balance.hpp"
#include "stages/pixels/search_windows.hpp"
#include "stages/prepare/census.hpp"

namespace mtstereo {

/// The costs of guided pixel matching, two rows at a time: differing bits of the census transforms,
/// summed over a small window, the difference of the gray values, and a penalty for disparities
/// that the guide does not expect. The window makes near objects too wide; gray values are those of
/// the pixel alone. The costs of a row are stored pixel by pixel, those in its window. Disparities
/// without a right pixel (d > x) use the first pixel of the right row, so that they cost nothing
/// where the image is flat.

struct CensusCostOptions {
  int disparities;    ///< D
  int kernel_size;    ///< side of the window over which costs are summed: 1, 3 or 5 px
  int range_penalty;  ///< added to the cost of an unexpected disparity [bits], 0 .. 32
};

/// Cost of a difference of one gray value [steps of the costs].
inline constexpr int kGrayCost = 2;

/// A larger difference costs as much as this one [gray values]: partners that a shadow or a
/// reflection makes different.
inline constexpr int kMostGrayDifference = 10;

/// Cost of the cells d >= D.
inline constexpr int kCensusNever = 255;

/// Steps of the costs per differing bit: the number of rows over which costs are summed. Along the
/// row costs are averaged, so that one step is one bit of one row.
inline int cost_scale(const CensusCostOptions& options) { return options.kernel_size; }

/// The order of the rows.
enum class RowDirection { kDown, kUp };

/// Gray values that are compared after balancing them. The balance is that of views of half their
/// size.
struct GrayPair {
  GrayView left, right;
  const GrayBalance& balance;
};

/// What the costs are of.
struct CostViews {
  const CensusImage& left;
  const CensusImage& right;
  const GrayPair* gray = nullptr;  ///< nullptr: the costs are those of the census
};

/// Scratch memory of one thread, and its state between rows.
struct CensusCostScratch {
  Buffer<std::uint8_t> planes;  ///< two rows of the right view, split into byte planes
  Buffer<std::uint8_t> counts;  ///< differing bits of the pairs of rows before the entering one
  Buffer<std::uint8_t> sums;    ///< over the rows of each window, of a tile's columns
  Buffer<std::uint8_t> tables;  ///< penalties below and above a range
  Buffer<std::uint8_t> grays;   ///< two rows of both views

  RowDirection direction;  ///< of start_census_costs()

  void resize(int width, const CensusCostOptions& options);
};

/// Begins with row y, an even one. The calls of census_cost_rows() that follow have to pass the
/// rows y, y + 2 ... or, upwards, y, y - 2 ... in this order, and the same windows.
void start_census_costs(const CostViews& views, const SearchWindows& windows,
                        const CensusCostOptions& options, int y, RowDirection direction,
                        CensusCostScratch& scratch);

/// Writes the costs of the rows y (`upper`) and y + 1 (`lower`), row_cells() each. y is the row
/// passed to start_census_costs() or the one after that of the previous call; if y + 1 is not in
/// the image, its costs have no meaning. Disparities outside low[x] .. high[x] cost the penalty
/// more, in both rows. Sums saturate at 255.
void census_cost_rows(const CostViews& views, const SearchWindows& windows,
                      const CensusCostOptions& options, int y, const std::uint16_t* low,
                      const std::uint16_t* high, CensusCostScratch& scratch, std::uint8_t* upper,
                      std::uint8_t* lower);

}  // namespace mtstereo
