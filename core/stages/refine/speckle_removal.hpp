// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/buffer.hpp"

namespace mtstereo {

/// Removes speckles: small patches of disparities that differ from all their surroundings. Two
/// pixels with a common edge are connected if their disparities differ by at most a tolerance; a
/// connected component of fewer pixels than a given size is a speckle.
///
/// Call find_runs() for all bands of rows, join_bands() once, then remove_small() for all bands.
/// The result depends neither on the bands nor on their order.

/// The runs of connected pixels of each row, and the components that they belong to. Run indices
/// are unique in the image; the runs of a band are packed from the index of the band's first pixel
/// on, so that few memory pages are accessed if there are few runs.
struct SpeckleRuns {
  int width = 0;                 ///< of the map [px]
  int height = 0;                ///< of the map [px]
  Buffer<std::uint32_t> first;   ///< per row: index of the first run
  Buffer<std::uint32_t> last;    ///< per row: one more than the index of the last run
  Buffer<std::uint16_t> begin;   ///< per run: first column [px]
  Buffer<std::uint16_t> end;     ///< per run: one more than the last column [px]
  Buffer<std::uint64_t> starts;  ///< per row and word of columns: the bits of those that begin runs
  /// Per run: the next run on the path to its component's root; for the root itself kRootRun plus
  /// the component's number of pixels.
  Buffer<std::uint32_t> link;

  /// The only function that allocates: 8 bytes per pixel, of which only those of existing runs are
  /// accessed, and a bit.
  void resize(int map_width, int map_height);

  /// Words of 64 columns in a row.
  static int row_words(int columns) { return (columns + 63) / 64; }
  /// The words of `starts` of row y.
  std::uint64_t* starts_of(int y) { return starts.data() + std::ptrdiff_t{y} * row_words(width); }
};

/// Flag in SpeckleRuns::link that marks a root, whose entry is a number of pixels and not the index
/// of another run.
inline constexpr std::uint32_t kRootRun = 1u << 31;

/// Writes the first and the last column of each run of connected pixels of a row, and the words of
/// SpeckleRuns::starts, unless that is nullptr. Returns the number of runs. The row has the padding
/// of an Image; `begin` and `last` hold `width` entries.
int find_runs_of_row(const std::int32_t* row, int width, std::int32_t tolerance,
                     std::uint16_t* begin, std::uint16_t* last, std::uint64_t* starts);

/// Finds the runs of the rows y0 .. y1 - 1 and connects them to one another. Disparities that
/// differ by at most `tolerance` [1/256 px] are connected.
void find_runs(const Image<std::int32_t>& map, std::int32_t tolerance, int y0, int y1,
               SpeckleRuns& runs);

/// Connects the runs of adjacent bands, after find_runs() for the rows 0 .. band - 1, band ..
/// 2 band - 1 and so on.
void join_bands(const Image<std::int32_t>& map, std::int32_t tolerance, int band,
                SpeckleRuns& runs);

/// The root of the run's component. Changes nothing, so that several threads may call it.
std::uint32_t root_of(const SpeckleRuns& runs, std::uint32_t run);

/// Share of a map's pixels from which on a component has full weight: 1 / kFullArea.
inline constexpr int kFullArea = 10;

/// Removes from the rows y0 .. y1 - 1 the components with fewer than `size` pixels in the whole
/// map, after join_bands(). A size of 0 or 1 removes nothing. `area`, unless it is nullptr, becomes
/// the weight of each pixel's component in the confidence: 255 * min(1, pixels / (map's pixels /
/// kFullArea))^0.1, rounded down, and 0 without a component. Wrong disparities form smaller areas
/// than right ones.
void remove_small(const SpeckleRuns& runs, int size, int y0, int y1, Image<std::int32_t>& map,
                  Image<std::uint8_t>* area);

}  // namespace mtstereo
