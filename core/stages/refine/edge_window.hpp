// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

/// The inputs of edge_alignment.hpp, in the form that the kernels of all SIMD targets share.

namespace mtstereo {

/// Half the side of the window [px].
inline constexpr int kEdgeRadius = 6;

/// Every kEdgeStep-th row and column of the window counts.
inline constexpr int kEdgeStep = 3;

/// The window's rows that count, and as many columns.
inline constexpr int kEdgeSide = 2 * kEdgeRadius / kEdgeStep + 1;

/// The rows of a window. Column x of the map is at kEdgeRadius + x.
struct EdgeWindow {
  const std::int16_t* disparity[kEdgeSide];
  const std::uint8_t* gray[kEdgeSide];
  const std::uint8_t* middle;  ///< the gray values of the window's middle row
};

/// A row of the map and the next one, or the row itself; and which of their pixels changed, nullptr
/// if that does not matter.
struct JumpRows {
  const std::int32_t* map;
  const std::int32_t* next;
  const std::uint8_t* changed;
  const std::uint8_t* next_changed;
};

}  // namespace mtstereo
