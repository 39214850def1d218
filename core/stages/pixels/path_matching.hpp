// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/image.hpp"
#include "stages/pixels/census_cost.hpp"
#include "stages/pixels/disparity_selection.hpp"
#include "stages/pixels/row_walk.hpp"
#include "stages/pixels/search_windows.hpp"
#include "stages/prepare/census.hpp"

namespace mtstereo {

/// Matching of all pixels by the census cost and paths, two along the row and up to two along the
/// column: runs census_cost, column_optimization, row_walk and disparity_selection.
/// Instead of the nodes, the map of the views at half the resolution says which disparities are
/// expected.

/// The most rows of a chunk, which is matched at once. The costs of more rows would leave the
/// cache.
inline constexpr int kPathRows = 32;

/// The same at lower resolutions, which have shorter rows.
inline constexpr int kReducedPathRows = 64;

/// The paths along the columns start this many rows outside of a chunk, so that chunks do not
/// depend on each other. What is further away has hardly any effect on them.
inline constexpr int kPathMargin = 8;

/// Reach of the expected range on both sides of twice the half map's disparity [px].
inline constexpr int kPathReach = 3;

/// Every so many rows vote by their costs alone.
inline constexpr int kCostVotingRows = 2;

/// What the views at one resolution are matched from.
struct PathMatchingInput {
  GrayView image;  ///< the left view
  CostViews costs;
  const Image<std::int32_t>* half_map;  ///< of half the resolution, or nullptr
  const SearchWindows& windows;
};

/// The paths along the columns beside those along the rows.
enum class ColumnPaths {
  kNone,
  kFromAbove,  ///< counts twice, for the one from below as well
  kBoth
};

struct PathMatchingOptions {
  CensusCostOptions cost;
  SmoothnessOptions smoothness;
  SelectionOptions selection;
  ColumnPaths column_paths;
  int most_rows = kPathRows;  ///< of a chunk with column paths; a multiple of kWindowTile
};

/// Rows of a chunk. Paths along the columns depend on the chunks, so those are the same for any
/// number of threads: an even number of them, but for rounding, keeps two threads busy. Without
/// such paths, chunks of any rows give the same result; the first rows of each take more time.
inline int path_rows(const PathMatchingOptions& options, int height, int threads) {
  if (options.column_paths == ColumnPaths::kNone) return threads == 1 ? height : kPathRows;
  const auto quotient = [](int a, int b) { return (a + b - 1) / b; };
  const int chunks = 2 * quotient(height, 2 * options.most_rows);
  return quotient(height, chunks * kWindowTile) * kWindowTile;  // whole tiles
}

/// Rows that are walked along together, in pairs, whose costs are found together.
inline constexpr int kWalkedPairs = kWalkedRows / 2;

/// The disparities that are expected in each column.
struct ExpectedRange {
  Buffer<std::uint16_t> low;
  Buffer<std::uint16_t> high;
};

/// Scratch memory of one thread. With paths from below, the costs of a chunk and its margins and
/// the path costs from below of a chunk, otherwise the costs of kWalkedRows rows.
struct PathMatchingScratch {
  std::array<ExpectedRange, kWalkedPairs> expected;  ///< of two rows each
  CensusCostScratch cost;
  RowWalkScratch walk;
  std::array<Candidates, kWalkedRows> candidates;
  Buffer<std::uint8_t> costs;
  Buffer<std::uint8_t> below;        ///< of the chunk's rows and the one after them
  Buffer<std::uint8_t> above;        ///< of kWalkedRows rows
  Buffer<std::uint8_t> moved;        ///< of one row, in the windows of the next one
  Buffer<std::uint8_t> least;        ///< of a row's columns
  Buffer<std::uint8_t> large_steps;  ///< between two rows
  Buffer<std::int32_t> by_cost;      ///< the disparities of a row by its costs alone
  Buffer<std::uint8_t> by_cost_ratio;

  /// For views of this size. match_along_paths() calls it as well, since one thread matches views
  /// of different sizes in turn.
  void resize(int width, int height, const PathMatchingOptions& options);
};

/// The disparities that are expected in row y: within kPathReach of twice the half map's disparity,
/// and all where the half map has none, or without a half map (nullptr).
void find_expected(const Image<std::int32_t>* half_map, int y, int width, int disparities,
                   std::uint16_t* low, std::uint16_t* high);

/// Writes the disparities and peak ratios of the rows y0 .. y1 - 1. y0 is a multiple of
/// path_rows(), and y1 the next one or the height. Counts the votes of these rows, unless `votes`
/// is nullptr.
void match_along_paths(const PathMatchingInput& input, const PathMatchingOptions& options, int y0,
                       int y1, PathMatchingScratch& scratch, Image<std::int32_t>& map,
                       Image<std::uint8_t>& ratio, WindowVotes* votes);

}  // namespace mtstereo
