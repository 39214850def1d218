// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "stages/cost_volume.hpp"

namespace mtstereo {

/// Step 9 (paper, "guided pixel matching" and "Confidence check"): each pixel's own best disparity
/// near the one it has.

struct PixelMatchingOptions {
  double search_range;  ///< omega_omega: share of the disparity that is searched on both sides
  double confidence;    ///< omega_Pi: the runner-up has to cost more than this share above the best
  bool subpixel;        ///< refine by a parabola through the best and its two neighbors
};

/// Replaces the disparities of the rows y0 .. y1 - 1: from d * (1 - search_range) to
/// d * (1 + search_range), both included and at least kMinSearch px on both sides, the one of least
/// cost. It is kept only where the best of the others, those next to it left out, costs more than
/// `confidence` above it.
void match_pixels(const CostVolume& volume, const PixelMatchingOptions& options, int y0, int y1,
                  Image<std::int32_t>& map);

/// Least distance that is searched on both sides of a disparity [px].
inline constexpr int kMinSearch = 3;

}  // namespace mtstereo
