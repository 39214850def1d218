// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/image.hpp"
#include "stages/pixels/gray_balance.hpp"
#include "stages/prepare/contrast.hpp"
#include "stages/refine/block_grid.hpp"

namespace mtstereo {

/// The clues about the pixels of a complete map that reliability.hpp rates.

/// Reach of the window whose share of matched pixels is a clue [px].
inline constexpr int kShareReach = 12;

/// The largest difference of two gray values that counts.
inline constexpr int kMostMismatch = 85;

/// The texture around a pixel: changes of the gray value, each this much at most, in rows of
/// kTextureSide pixels kTextureStep rows above, at and below the pixel.
inline constexpr int kMostChange = 28;
inline constexpr int kTextureSide = 9;
inline constexpr int kTextureStep = 4;
static_assert(kMostChange * kTextureSide < 256);

/// Steps per px of the disparities that are compared.
inline constexpr int kClueOne = 16;

/// A surface that is nearer or farther by more is another one [steps of 1 / kClueOne px].
inline constexpr int kOtherSurface = 2 * kClueOne;

/// Distances at which nearer surfaces to the left are looked for, and farther ones in four
/// directions [px].
inline constexpr std::array kNearerDistances = {1, 2, 3, 4, 6, 8, 10, 12, 15};
inline constexpr std::array kFartherDistances = {1, 2, 3, 4, 6, 8};

/// Columns of ClueMaps::disparity outside of the map, on both sides.
inline constexpr int kClueBorder = 16;
static_assert(kNearerDistances.back() < kClueBorder && kFartherDistances.back() < kClueBorder);

/// What a map's rows say about their pixels, for the windows of other rows.
struct ClueMaps {
  Image<std::int16_t> disparity;  ///< [1 / kClueOne px], with borders that repeat the ends
  Image<std::uint8_t> matched;    ///< matched pixels among those within kShareReach columns
  Image<std::uint8_t> mismatch;   ///< sum of three columns of differences of gray values
  Image<std::uint8_t> texture;    ///< sum of the changes in a row of kTextureSide pixels

  void resize(int width, int height, ReusedMemory* reused = nullptr);
};

/// Scratch memory of one thread.
struct ClueScratch {
  Buffer<std::uint8_t> marks;     ///< of a row, with borders of kShareReach
  Buffer<std::uint8_t> values;    ///< of a row, with the borders of its sums
  Buffer<std::uint8_t> left;      ///< a row of the left view, as bright as the right one
  Buffer<std::uint8_t> right;     ///< a row of the right view with borders
  Buffer<std::uint32_t> partner;  ///< of a row's pixels: its place in `right`, then the gray values

  /// For maps and right views of at most this width.
  void resize(int width);
};

/// The map of half the matched resolution that guided the matching: complete and rated.
struct RatedGuide {
  const Image<std::int32_t>* disparity = nullptr;  ///< nullptr: there is none
  const Image<std::uint8_t>* confidence = nullptr;
};

/// The fine detail of views in which it was not measured: they are taken for sharp ones.
inline constexpr float kUnknownDetail = 1;

/// What the clues are about, beside the map.
struct RatedViews {
  GrayView left;      ///< of the map's size
  GrayView right;     ///< as it was matched; of the same size
  float noise_level;  ///< of the noisier view

  /// The shares of agreeing pixels in tiles of this size (agreement.hpp).
  const Image<std::uint8_t>* agreement;
  int agreement_tile;
  const GrayBalance* balance;  ///< of the views, or of views of half their size

  int clipped_from = kNothingClipped;  ///< in the left view
  RatedGuide guide = {};
  float fine_detail = kUnknownDetail;  ///< FineDetail::share()
  int grid_level = 0;                  ///< BlockGrid::level()
  int block_side = kBlockSide;         ///< BlockGrid::side
  bool halved = false;                 ///< the views have half the resolution of the input
};

/// Reads the rows y0 .. y1 - 1 of the map. Pixels with a confidence above kMostInferred are matched
/// ones. The mismatch of a pixel is the least difference between its gray value and those of the
/// three pixels of the right view around its partner, after balancing them.
void gather_clues(const RatedViews& views, const Image<std::int32_t>& map,
                  const Image<std::uint8_t>& confidence, int y0, int y1, ClueScratch& scratch,
                  ClueMaps& clues);

}  // namespace mtstereo
