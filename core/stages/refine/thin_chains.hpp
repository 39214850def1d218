// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/image.hpp"

namespace mtstereo {

/// Finds thin structures in the map of the matching: posts, rails, wires. They are too small for
/// the speckle removal and too narrow for the confidence, although most of their disparities are
/// right. They differ from wrong disparities in two ways: they continue over many lines, and the
/// right view agrees with their disparity, not with the background's.
///
/// A *line* is a row, or a column for objects that lie along the rows. A *thin run* is a run of
/// connected pixels of a line that is nearer than what is before and after it. Thin runs of
/// successive lines that overlap and have about the same disparity form a *chain*.
///
/// Call find_thin_runs() for all bands of lines, link_thin_runs() once, rate_thin_runs() for all
/// bands, accept_chains() once, then mark_thin_pixels() for all bands. The result depends neither
/// on the bands nor on their order.

/// Whether the lines that a chain crosses are rows or columns.
enum class Lines { kRows, kColumns };

/// Largest width of a thin run, and of the gap between it and the background [px]. The matching
/// widens what is thin by half of its window on both sides: a post of 8 px is up to 13 px wide.
inline constexpr int kMostThinWidth = 13;

/// The background is at least this much farther [1/256 px].
inline constexpr std::int32_t kThinStep = 2 * kDisparityOne;

/// With more noise, chains are not searched: what the right view confirms is then by chance [gray
/// values, of the views before they are filtered].
inline constexpr float kMostThinNoise = 7.5F;

/// A line of n px has at most n / kThinSpacing + 1 thin runs; further ones are not kept.
inline constexpr int kThinSpacing = 8;

/// Number of runs of a chain before and after a run that its pixels are averaged over.
inline constexpr int kThinReach = 4;

/// Largest difference between two gray values that counts.
inline constexpr int kMostThinDifference = 30;

/// What a chain needs in order to be accepted; gray values are in 1/16.
struct ThinRules {
  int runs;        ///< least number of runs
  int gain;        ///< least mean evidence
  int convincing;  ///< least share of runs with more than kThinConvincing evidence [%]
};
inline constexpr ThinRules kThinRowRules{12, 4 * 16, 80};
inline constexpr ThinRules kThinColumnRules{20, 2 * 16, 50};
inline constexpr int kThinConvincing = 8;
inline constexpr int kMostThinMisfit = 15 * 16;  ///< largest mean difference from the right view
inline constexpr int kThinEnclosed = 50;  ///< least share of runs with background on both sides [%]

/// What a pixel needs in order to be kept, in means along the chain [gray values].
inline constexpr int kLeastPixelGain = 2;   ///< its evidence is above this
inline constexpr int kMostPixelMisfit = 4;  ///< its difference from the right view at most this

/// A pixel, in means along the chain or of one run.
struct ThinPixel {
  std::int8_t gain;  ///< evidence: by how much the right view is more like the pixel at the run's
                     ///< disparity than at the background's
  std::uint8_t misfit;  ///< difference from the right view at the run's disparity
  std::uint8_t gray;    ///< gray value
};

/// The pixels of a run, and one before and after it.
using ThinProfile = std::array<ThinPixel, kMostThinWidth + 2>;

/// A thin run.
struct ThinRun {
  std::uint16_t begin;     ///< first position in the line
  std::uint16_t end;       ///< one more than the last one
  std::int32_t disparity;  ///< mean [1/256 px]
  std::int32_t before;     ///< disparity of the background before it, or kNoDisparity
  std::int32_t after;      ///< the same after it
  std::int32_t previous;   ///< index of the run that it continues, of one of two lines, or -1
  std::int32_t next;       ///< index of the first run that continues it, or -1
  std::int32_t chain;      ///< index of the chain's first run
  std::int16_t gain;       ///< mean over its pixels [1/16 gray value]
  std::int16_t misfit;     ///< mean over its pixels [1/16 gray value]
  ThinProfile pixels;
};

/// A chain, at the index of its first run: sums over its runs, see ThinRules.
struct ThinChain {
  std::int32_t runs;
  std::int32_t gain;
  std::int32_t misfit;
  std::int32_t convincing;
  std::int32_t enclosed;
  std::int32_t accepted;  ///< 0 or 1
};

/// The thin runs of all lines. Those of a band are packed, so that few memory pages are accessed if
/// there are few runs.
struct ThinRuns {
  Lines direction = Lines::kRows;
  int lines = 0;
  int capacity = 0;            ///< of a line; the runs of a band begin at its first line * capacity
  Buffer<std::int32_t> first;  ///< per line: index of its first run
  Buffer<std::int32_t> count;  ///< per line: number of its runs
  Buffer<ThinRun> run;
  Buffer<ThinChain> chain;

  /// The only function that allocates. Sufficient for the rows and the columns of such a map.
  void resize(int width, int height);
  /// Prepares for the rows or the columns of a map of this size.
  void start(Lines lines_direction, int width, int height);
};

/// Scratch memory of one thread.
struct ThinScratch {
  Buffer<std::uint16_t> begin, last;  ///< of the runs of a line

  void resize(int width, int height);
};

/// The matched views.
struct ThinViews {
  GrayView left, right;
};

/// Writes the columns x0 .. x1 - 1 of the map as the first rows of `columns`.
void transpose(const Image<std::int32_t>& map, int x0, int x1, Image<std::int32_t>& columns);

/// Finds the thin runs of these lines, which are the rows from `row` on of the map or of its
/// transposed columns.
void find_thin_runs(const Image<std::int32_t>& map, int row, int line0, int line1,
                    ThinScratch& scratch, ThinRuns& runs);

/// Links the runs to chains.
void link_thin_runs(ThinRuns& runs);

/// Compares the pixels of these lines' runs with the right view, for chains of sufficient length.
void rate_thin_runs(const ThinViews& views, int line0, int line1, ThinRuns& runs);

/// Selects the chains.
void accept_chains(ThinRuns& runs);

/// Replaces the disparities of the pixels of accepted chains by their negatives, in these lines of
/// a copy of the map. A pixel stays unchanged if the right view does not agree with it along the
/// chain, or if its gray value is more like the outside of the run than like its middle: then the
/// matching has widened the object.
void mark_thin_pixels(const ThinRuns& runs, int line0, int line1, Image<std::int32_t>& copy);

}  // namespace mtstereo
