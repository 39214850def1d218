// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "stages/pixels/scanline_optimization.hpp"

/// Internal to scanline_optimization.cpp: the layout of ScanlineScratch::ends.

namespace mtstereo {

/// The two paths, as indices.
inline constexpr int kFromLeft = 0;
inline constexpr int kFromRight = 1;

/// The path costs of one of the path's last two pixels (`which`: 0 or 1).
inline std::uint8_t* path_end(ScanlineScratch& scratch, int lanes, int path, int which) {
  return scratch.ends.data() + (2 * path + which) * lanes;
}

}  // namespace mtstereo
