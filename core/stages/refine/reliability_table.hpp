// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>

/// The clues about a pixel and the fitted tables of reliability.cpp.

namespace mtstereo {

/// What is known of a disparity.
enum Clue : int {
  kSupportClue,    ///< its confidence so far
  kShareClue,      ///< the share of matched pixels around it
  kMismatchClue,   ///< the difference of the gray values of the two views
  kNearerClue,     ///< the distance of the next nearer surface to the left
  kFartherClue,    ///< the distance of the next farther surface
  kPartnerClue,    ///< how far inside of the right view its partner is
  kTextureClue,    ///< the gray values' changes along the rows around it
  kAgreementClue,  ///< how often the costs alone agree with the paths around it
  kGuideClue,      ///< the confidence of the map of half the resolution, and the distance from it
  kGridClue,       ///< how near it is to a multiple of the block size of the views' compression
  kNoiseClue,      ///< the noise of the views
  kDetailClue,     ///< how much of the scene their finest octave shows
};
inline constexpr int kClues = 12;

/// The clues about single pixels; the others are the same for all pixels of a pair.
inline constexpr int kPixelClues = kNoiseClue;

inline constexpr int kClueBins = 32;

/// Steps per 1 of the table's entries.
inline constexpr int kReliabilityOne = 16;

using ReliabilityTable = std::array<std::array<std::int16_t, kClueBins>, kClues>;

/// A clue says less, or more, in views of another quality. So a table is the sum of parts, each
/// times its share in the pair's views.
enum TablePart : int {
  kAnyPart,     ///< of all views
  kSoftPart,    ///< of soft views
  kNoisyPart,   ///< of noisy views
  kBlockyPart,  ///< of views with the blocks of a compression
};
inline constexpr int kTableParts = 4;

using TableParts = std::array<ReliabilityTable, kTableParts>;
using PartShares = std::array<float, kTableParts>;  ///< 0 .. 1

/// The kinds of maps whose pixels are rated, each by a table of its own.
enum class RatedMap {
  kComplete,      ///< any pixel may be kept
  kHalfComplete,  ///< the same of views that are matched at half resolution
  kMatched,       ///< only matched pixels are kept
  kHalfMatched,   ///< the same of views that are matched at half resolution
  kGuide,         ///< the map of half the matched resolution, for kGuideClue of the others
};
inline constexpr int kRatedMaps = 5;

/// The fitted tables, by RatedMap.
extern const std::array<TableParts, kRatedMaps> kReliabilityTables;

}  // namespace mtstereo
