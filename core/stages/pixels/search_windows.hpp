// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "stages/pixels/cost_lanes.hpp"

namespace mtstereo {

/// Path matching at full resolution leaves out the disparities that nothing at half the resolution
/// points to. This takes less than half the time and changes hardly any pixel.
///
/// The views at half the resolution vote, pixel by pixel, for disparities: with the result of their
/// paths, and with the result of their costs alone, which also finds objects too thin for the
/// paths. The pixels of a tile are matched in one window, which contains all disparities that
/// got votes in this tile and the eight around it.

/// The votes in each tile for each kWindowStep disparities ("bin"). A tile of the views has
/// kWindowTile / 2 rows and columns at half the resolution.
struct WindowVotes {
  /// For views of this size, matched at so many lanes.
  void resize(int width, int height, int lanes);

  int columns = 0;  ///< tiles
  int rows = 0;
  int bins = 0;
  Buffer<std::uint8_t> known;    ///< [row][column]: pixels with a disparity
  Buffer<std::uint8_t> by_path;  ///< [row][column][bin]
  Buffer<std::uint8_t> by_cost;
  Buffer<std::uint8_t> compared;  ///< [row][column]: pixels in rows that are matched in both ways
  Buffer<std::uint8_t> agreeing;  ///< of these, pixels with about the same disparity in both
};

/// Rows of the views at half the resolution in a tile.
inline constexpr int kVotingRows = kWindowTile / 2;

/// A bin is in the window if it has this many votes by one of both kinds.
inline constexpr int kLeastPathVotes = 12;
inline constexpr int kLeastCostVotes = 3;

/// A pixel votes for disparities up to this far from its own [px of the views].
inline constexpr int kVoteReach = 2;

/// Two disparities at half the resolution agree if they differ by at most this [px].
inline constexpr int kMostDisagreement = 1;

/// With disparities in less than one of so many pixels, a window has all disparities.
inline constexpr int kLeastKnownShare = 10;

/// Forgets the votes of the tile rows of the rows y0 .. y1 - 1 at half the resolution. y0 is a
/// multiple of kVotingRows, and y1 the next one or the height.
void clear_votes(int y0, int y1, WindowVotes& votes);

/// Counts the votes and the agreeing pixels of row y at half the resolution, the result of its
/// paths and of its costs alone [1 / kDisparityOne px of half the resolution]; `by_cost` is nullptr
/// in rows that are not matched by their costs alone.
void count_votes(const std::int32_t* by_path, const std::int32_t* by_cost, int width, int y,
                 WindowVotes& votes);

/// The votes of the tiles of a row, each with those of the tiles around it.
struct TileSums {
  void resize(int columns, int bins);

  Buffer<std::uint16_t> known;    ///< [column]
  Buffer<std::uint16_t> by_path;  ///< [column][bin]
  Buffer<std::uint16_t> by_cost;
  Buffer<std::uint16_t> rows;  ///< scratch: the sums of three rows, with a tile more on both sides
};

/// The windows of a view.
class SearchWindows {
 public:
  /// Windows that do not depend on votes: all disparities.
  SearchWindows() = default;

  /// For views of this size, matched at so many lanes.
  void resize(int width, int height, int lanes);

  /// The windows of the tiles of row y; nullptr = all lanes.
  const CostWindow* row(int y) const;

  /// Windows that contain the windows of the rows first .. last, at most kWindowTile, and perhaps
  /// more.
  const CostWindow* covering(int first, int last) const;

 private:
  friend void choose_windows(const WindowVotes& votes, SearchWindows& windows);

  int columns_ = 0;  // tiles; 0 = all lanes
  int rows_ = 0;
  int height_ = 0;
  TileSums sums_;
  Buffer<CostWindow> own_;
  Buffer<CostWindow> joined_;  // of a row of tiles and the one below
};

/// Sets the windows from all votes.
void choose_windows(const WindowVotes& votes, SearchWindows& windows);

}  // namespace mtstereo
