// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "stages/pixels/scanline_optimization.hpp"

/// Internal to scanline_optimization.cpp: the layout of ScanlineScratch::ends.

namespace mtstereo {

/// Cells before and after each pixel's path costs. They hold the highest cost, so that no step
/// comes from there.
inline constexpr int kEndMargin = 64;

/// The two paths, as indices.
inline constexpr int kFromLeft = 0;
inline constexpr int kFromRight = 1;

/// The path costs of one of the path's last two pixels (`which`: 0 or 1).
inline std::uint8_t* path_end(ScanlineScratch& scratch, int lanes, int path, int which) {
  return scratch.ends.data() + kEndMargin + (2 * path + which) * (lanes + kEndMargin);
}

}  // namespace mtstereo
