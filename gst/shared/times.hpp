// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <cstdint>

namespace mtstereo::plugin {

/// A running time or a difference of two [ns]. Signed: a frame may begin before its segment.
using Nanoseconds = std::int64_t;

/// No time is farther from 0 than this, 146 years [ns]: the sum and the difference of two do not
/// overflow.
inline constexpr Nanoseconds kFarthestTime = (Nanoseconds{1} << 62) - 1;

/// A time from a source, or calculated from two times. Beyond kFarthestTime, which only a wrong
/// time stamp reaches, it is the nearest one in range.
constexpr Nanoseconds bounded(std::int64_t time) {
  return std::clamp(time, -kFarthestTime, kFarthestTime);
}
constexpr Nanoseconds bounded(std::uint64_t time) {
  return static_cast<Nanoseconds>(std::min<std::uint64_t>(time, kFarthestTime));
}
constexpr Nanoseconds bounded(double time) {
  return bounded(static_cast<std::int64_t>(std::clamp(time, -0x1p62, 0x1p62)));
}

}  // namespace mtstereo::plugin
