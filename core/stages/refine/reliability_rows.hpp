// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "stages/refine/reliability.hpp"

/// Internal to reliability.cpp: the types that the kernels of all SIMD targets share.

namespace mtstereo {

/// The bin of the clues about other surfaces where there is none.
inline constexpr std::int16_t kNoSurface = 16;

/// The rows that the clues about other surfaces read; column x of the map is at x.
struct SurfaceRows {
  const std::int16_t* middle;
  const std::int16_t* above[kFartherDistances.size()];  ///< at these distances
  const std::int16_t* below[kFartherDistances.size()];
};

}  // namespace mtstereo
