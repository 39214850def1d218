// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"

namespace mtstereo {

/// Removes speckles: small patches of disparities that nothing around them agrees with. Two pixels
/// that touch by an edge are connected where their disparities differ by at most a tolerance; a
/// connected component of fewer pixels than a given size is a speckle.
///
/// find_runs() on bands of rows, join_bands() once, then remove_small() on bands of rows. What is
/// removed depends neither on the bands nor on the order they come in.

/// The connected pixels of each row, as runs, and which runs belong together. A run's index counts
/// through the image; the runs of a band are packed from the index of its first pixel on, so that
/// few pages are touched where runs are few.
struct SpeckleRuns {
  int width = 0;                ///< of the map [px]
  int height = 0;               ///< of the map [px]
  Buffer<std::uint32_t> first;  ///< of each row the index of the first run
  Buffer<std::uint32_t> last;   ///< of each row one more than the index of the last run
  Buffer<std::uint16_t> begin;  ///< of each run the first column [px]
  Buffer<std::uint16_t> end;    ///< of each run one more than the last column [px]
  /// Of each run another run of its component, on the way to the root of all of them; of the root
  /// kRootRun and the component's number of pixels.
  Buffer<std::uint32_t> link;

  /// The only one that allocates: 8 bytes a pixel, of which those of runs that are there get used.
  void resize(int map_width, int map_height);
};

/// Tells a root's number of pixels from the index of another run in SpeckleRuns::link.
inline constexpr std::uint32_t kRootRun = 1u << 31;

/// Finds the runs of the rows y0 .. y1 - 1 and connects them to one another. Disparities that
/// differ by at most `tolerance` [1/256 px] are connected.
void find_runs(const Image<std::int32_t>& map, std::int32_t tolerance, int y0, int y1,
               SpeckleRuns& runs);

/// Connects the runs of bands that touch, after find_runs() for the rows 0 .. band - 1, band ..
/// 2 band - 1 and so on.
void join_bands(const Image<std::int32_t>& map, std::int32_t tolerance, int band,
                SpeckleRuns& runs);

/// Removes from the rows y0 .. y1 - 1 the components that have fewer than `size` pixels in the
/// whole map, after join_bands(). Nothing is removed with a size of 0 or 1.
void remove_small(const SpeckleRuns& runs, int size, int y0, int y1, Image<std::int32_t>& map);

}  // namespace mtstereo
