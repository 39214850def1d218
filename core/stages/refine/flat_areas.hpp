// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/image.hpp"
#include "stages/refine/speckle_removal.hpp"

namespace mtstereo {

/// Finds the flat areas of a view: pixels of the view at a half or a quarter of its size that are
/// connected by neighbors of nearly the same gray value. Such an area mostly belongs to one
/// surface.
///
/// Call sum_grays() for all bands of rows of the reduced view, find_runs() (speckle_removal.hpp)
/// with flat_step() for the same bands, join_bands() and then number_areas().

/// Neighbors that differ by more are not connected, at half and at a quarter of the size
/// [1 / 4 gray value].
inline constexpr int kHalvedFlatStep = 8;
inline constexpr int kQuarteredFlatStep = 12;

/// In views whose gray values have a smaller standard deviation, the step is smaller as well.
inline constexpr double kFullContrast = 40;

/// The least step, by the noise of the view, which would break the areas into pieces.
inline constexpr float kFlatNoise = 2;

/// A smaller area is none [px of the view].
inline constexpr int kLeastFlatArea = 300;

/// Sums over the pixels of rows.
struct GrayTotals {
  std::uint64_t count = 0;
  std::uint64_t sum = 0;
  std::uint64_t squares = 0;

  void add(const GrayTotals& other);
};

/// A part of a row of the reduced view.
struct FlatSpan {
  std::uint16_t y = 0;
  std::uint16_t begin = 0;  ///< first column
  std::uint16_t end = 0;    ///< one more than the last column
};

/// The areas of a view. Run indices are those of SpeckleRuns.
struct FlatAreas {
  int scale = 2;                ///< pixels of the view per pixel of `gray`, 2 or 4, along rows
  Image<std::int32_t> gray;     ///< the reduced view [1 / 4 gray value], plus 1
  SpeckleRuns runs;             ///< of `gray`
  Buffer<std::uint32_t> area;   ///< per run: 1 plus the number of its area, 0 if it has none
  Buffer<std::uint32_t> first;  ///< per area: its first entry of `spans`; after the last: the end
  Buffer<FlatSpan> spans;       ///< the areas' runs, area by area, from top to bottom
  int count = 0;                ///< of the areas, in the order of their first pixels

  /// For a reduced view of this size.
  void resize(int width, int height);
};

/// Writes the rows y0 .. y1 - 1 of areas.gray, half of the size of `view`, and returns their sums.
/// `view` is the view itself or already halved, by areas.scale. The last column and the last row of
/// odd sizes are left out.
GrayTotals sum_grays(GrayView view, int y0, int y1, FlatAreas& areas);

/// The largest difference of neighbors that are connected [1 / 4 gray value], by FlatAreas::scale.
/// `noise` is the noise level of the view.
int flat_step(const GrayTotals& totals, int scale, float noise);

/// Writes `area`, `first`, `spans` and `count`.
void number_areas(FlatAreas& areas);

}  // namespace mtstereo
