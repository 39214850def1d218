// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

/// Internal to scanline_optimization.cpp: the layout of ScanlineScratch::ends.

namespace mtstereo {

/// The two paths, as indices.
inline constexpr int kFromLeft = 0;
inline constexpr int kFromRight = 1;

/// The path costs of one of the path's last two pixels (`which`: 0 or 1).
inline std::uint8_t* path_end(std::uint8_t* ends, int lanes, int path, int which) {
  return ends + (2 * path + which) * lanes;
}

}  // namespace mtstereo
