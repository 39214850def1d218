// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "stages/pixels/disparity_selection.hpp"
#include "stages/pixels/search_range.hpp"
#include "stages/prepare/cost_volume.hpp"

namespace mtstereo {

/// Step 9 (paper, "guided pixel matching" and "Confidence check") on the smoothed cost
/// volume: each pixel's own best disparity among those that the nodes expect.

struct PixelMatchingOptions {
  SearchRangeOptions range;
  SelectionOptions selection;
};

/// Scratch memory of one thread.
struct PixelMatchingScratch {
  Buffer<std::uint16_t> low;
  Buffer<std::uint16_t> high;

  void resize(int width);
};

/// Replaces the disparities of the rows y0 .. y1 - 1, which are the nodes', by the expected one of
/// least cost, and writes their peak ratios (0 where there is no disparity). A disparity is kept
/// only where the best of the others, those next to it left out, costs more than `confidence` above
/// it, and where the right pixel's best disparity agrees.
void match_pixels(const CostVolume& volume, const PixelMatchingOptions& options, int y0, int y1,
                  PixelMatchingScratch& scratch, Image<std::int32_t>& map,
                  Image<std::uint8_t>& ratio);

}  // namespace mtstereo
