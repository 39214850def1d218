// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

/// The window of edge_alignment.hpp, in the form that the kernels of all SIMD targets share.

namespace mtstereo {

/// Half the side of the window, of which every second row and column counts [px].
inline constexpr int kEdgeRadius = 6;

/// The window's rows that count, and as many columns.
inline constexpr int kEdgeSide = kEdgeRadius + 1;

/// The rows of a window. Column x of the map is at kEdgeRadius + x.
struct EdgeWindow {
  const std::int16_t* disparity[kEdgeSide];
  const std::uint8_t* gray[kEdgeSide];
  const std::uint8_t* middle;  ///< the gray values of the window's middle row
};

}  // namespace mtstereo
