// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "mtstereo/image.hpp"

namespace mtstereo {

/// Offset of the minimum of the parabola through three costs from the middle one, which is the
/// smallest: -1/2 .. 1/2 px, in 1 / kDisparityOne px.
inline int parabola_offset(int before, int best, int after) {
  const int curvature = before - 2 * best + after;
  if (curvature <= 0) return 0;
  return (before - after) * (kDisparityOne / 2) / curvature;
}

/// The excess of the runner-up's cost over the best cost, as a share of the runner-up's: 0 .. 255
/// for 0 .. 1. `offset` is added to the runner-up's cost: where all costs are near 0, as in flat,
/// saturated or compressed areas, a small excess would be a large share.
inline int peak_ratio(int best, int runner_up, int offset = 0) {
  if (runner_up <= best) return 0;
  // Faster than a division of integers, and as exact.
  const double excess = (runner_up - best) * 255;
  return static_cast<int>(excess / (runner_up + offset));
}

}  // namespace mtstereo
