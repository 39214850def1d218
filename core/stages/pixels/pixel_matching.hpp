// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "stages/pixels/disparity_selection.hpp"
#include "stages/pixels/search_range.hpp"
#include "stages/prepare/cost_volume.hpp"

namespace mtstereo {

/// The step gradient-matching (paper, "guided pixel matching" and "Confidence check") on the
/// smoothed cost volume: selects each pixel's best disparity among those that the nodes expect.

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

/// Replaces the nodes' disparities in the rows y0 .. y1 - 1 by the expected disparity of least cost
/// and writes its peak ratio (0 for pixels without a disparity). A disparity is kept only if the
/// best of the others, except those next to it, costs more by a share above `confidence`, and if
/// the right pixel's best disparity agrees.
void match_pixels(const CostVolume& volume, const PixelMatchingOptions& options, int y0, int y1,
                  PixelMatchingScratch& scratch, Image<std::int32_t>& map,
                  Image<std::uint8_t>& ratio);

}  // namespace mtstereo
