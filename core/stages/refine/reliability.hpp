// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/image.hpp"
#include "stages/refine/clues.hpp"
#include "stages/refine/reliability_table.hpp"

namespace mtstereo {

/// The confidence of each pixel of a complete map, matched or inferred: how likely the disparity is
/// right, by a table that was fitted to pairs with ground truth (pipelines/tools/fit/). Each clue
/// about a pixel selects an entry of its column of the table, and the sum of the entries is the
/// confidence.
///
/// Call gather_clues() (clues.hpp) for all bands of rows, then rate_reliability() for all bands.

/// Scratch memory of one thread.
struct ReliabilityScratch {
  Buffer<std::uint16_t> sum;
  Buffer<std::int32_t> expected;                  ///< by the guide, of a row
  std::array<Buffer<std::uint8_t>, kClues> bins;  ///< per clue, of a row

  /// For maps of at most this width.
  void resize(int width);
};

/// Finds the bins of row y for each clue: scratch.bins.
void find_clue_bins(const RatedViews& views, const Image<std::int32_t>& map,
                    const Image<std::uint8_t>& confidence, const ClueMaps& clues, int y,
                    ReliabilityScratch& scratch);

/// The shares of a table's parts in the views.
PartShares part_shares(const RatedViews& views);

/// The sum of the parts.
ReliabilityTable table_for(const TableParts& parts, const PartShares& shares);

/// Whether inferred disparities keep a confidence of at most kMostInferred, and matched ones a
/// higher one.
enum class Inferred { kApart, kLikeMatched };

/// Replaces the confidence of the rows y0 .. y1 - 1 by the sum of the table's entries, 1 .. 255.
void rate_reliability(const RatedViews& views, const Image<std::int32_t>& map,
                      const ClueMaps& clues, const ReliabilityTable& table, Inferred inferred,
                      int y0, int y1, ReliabilityScratch& scratch, Image<std::uint8_t>& confidence);

}  // namespace mtstereo
