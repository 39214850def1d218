// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/pairing/tolerance.hpp"

#include <algorithm>

namespace mtstereo::plugin {

std::optional<Nanoseconds> FrameDurations::shorter() const {
  if (left && right) return std::min(*left, *right);
  return left ? left : right;
}

Nanoseconds effective_tolerance(Nanoseconds set, const FrameDurations& caps,
                                const FrameDurations& buffers) {
  if (set >= 0) return set;
  if (const auto duration = caps.shorter()) return *duration / 2;
  if (const auto duration = buffers.shorter()) return *duration / 2;
  return kFallbackTolerance;
}

}  // namespace mtstereo::plugin
