// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>

namespace mtstereo {

/// How much something counts: 0 at `none` and beyond, 1 at `all` and beyond, linear between. `all`
/// may be the smaller one.
inline float ramp(float none, float all, float value) {
  return std::clamp((value - none) / (all - none), 0.0F, 1.0F);
}

}  // namespace mtstereo
