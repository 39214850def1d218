// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>

#include "matcher/base/sides.hpp"
#include "shared/times.hpp"

namespace mtstereo::plugin {

/// The tolerance if the frame duration is known neither from the caps nor from the buffers [ns].
inline constexpr Nanoseconds kFallbackTolerance = 20'000'000;

/// The frame duration of each side [ns], if known.
struct FrameDurations {
  std::optional<Nanoseconds> left;
  std::optional<Nanoseconds> right;

  std::optional<Nanoseconds>& of(Side side) { return side == Side::kLeft ? left : right; }
  const std::optional<Nanoseconds>& of(Side side) const {
    return side == Side::kLeft ? left : right;
  }
  /// The shorter of the known durations.
  std::optional<Nanoseconds> shorter() const;
};

/// The tolerance that applies: `set` if it is not negative, otherwise half of the shorter frame
/// duration of the caps, otherwise of the buffers, otherwise kFallbackTolerance. The shorter
/// duration ensures that a frame of a slow stream is not paired with a neighbor of its partner in a
/// fast stream.
Nanoseconds effective_tolerance(Nanoseconds set, const FrameDurations& caps,
                                const FrameDurations& buffers);

}  // namespace mtstereo::plugin
