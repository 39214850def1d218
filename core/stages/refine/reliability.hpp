// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/image.hpp"
#include "stages/refine/reliability_table.hpp"

namespace mtstereo {

/// The confidence of each pixel of a complete map, matched or inferred: how likely the disparity is
/// right, by a table that was fitted to pairs with ground truth (pipelines/fit/). Each clue about a
/// pixel selects an entry of its column of the table, and the sum of the entries is the confidence.
///
/// Call gather_clues() for all bands of rows, then rate_reliability() for all bands.

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

  void resize(int width, int height);
};

/// Scratch memory of one thread.
struct ReliabilityScratch {
  Buffer<std::uint8_t> marks;   ///< of a row, with borders of kShareReach
  Buffer<std::uint8_t> values;  ///< of a row, with the borders of its sums
  Buffer<std::uint16_t> sum;
  Buffer<std::uint8_t> right;     ///< a row of the right view with borders
  Buffer<std::uint32_t> partner;  ///< of a row's pixels: its place in `right`, then the gray values
  std::array<Buffer<std::uint8_t>, kClues> bins;  ///< per clue, of a row

  /// For maps and right views of at most this width.
  void resize(int width);
};

/// What the clues are about, beside the map.
struct RatedViews {
  GrayView left;         ///< of the map's size
  GrayView right;        ///< as it was matched; of the same height
  int disparity_offset;  ///< added to the map's disparities [px]
  float noise_level;     ///< of the noisier view
};

/// Reads the rows y0 .. y1 - 1 of the map. Pixels with a confidence above kMostInferred are matched
/// ones. The mismatch of a pixel is the least difference between its gray value and those of the
/// three pixels of the right view around its partner.
void gather_clues(const RatedViews& views, const Image<std::int32_t>& map,
                  const Image<std::uint8_t>& confidence, int y0, int y1,
                  ReliabilityScratch& scratch, ClueMaps& clues);

/// Finds the bins of row y for each clue: scratch.bins.
void find_clue_bins(const RatedViews& views, const Image<std::int32_t>& map,
                    const Image<std::uint8_t>& confidence, const ClueMaps& clues, int y,
                    ReliabilityScratch& scratch);

/// Whether the confidence of inferred disparities stays at most kMostInferred, and that of matched
/// ones above it.
enum class Inferred { kApart, kLikeMatched };

/// Replaces the confidence of the rows y0 .. y1 - 1 by the sum of the table's entries, 1 .. 255.
void rate_reliability(const RatedViews& views, const Image<std::int32_t>& map,
                      const ClueMaps& clues, Inferred inferred, int y0, int y1,
                      ReliabilityScratch& scratch, Image<std::uint8_t>& confidence);

}  // namespace mtstereo
