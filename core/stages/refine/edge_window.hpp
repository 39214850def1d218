// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "stages/refine/edge_alignment.hpp"

/// Internal to edge_alignment.cpp: the types that the kernels of all SIMD targets share.

namespace mtstereo {

/// The window's rows that count, and as many columns.
inline constexpr int kEdgeSide = kEdgeRadius + 1;

/// The rows of a window. Column x of the map is at kEdgeRadius + x.
struct EdgeWindow {
  const std::int16_t* disparity[kEdgeSide];
  const std::uint8_t* gray[kEdgeSide];
  const std::uint8_t* middle;  ///< the gray values of the window's middle row
};

}  // namespace mtstereo
