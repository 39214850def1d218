// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstddef>

#include "mtstereo/matcher.hpp"

namespace mtstereo::plugin {

inline constexpr std::array<Side, 2> kSides = {Side::kLeft, Side::kRight};

constexpr Side other_side(Side side) { return side == Side::kLeft ? Side::kRight : Side::kLeft; }

/// The index of a side in an array of two.
constexpr std::size_t index_of(Side side) { return static_cast<std::size_t>(side); }

/// "sink_left" or "sink_right".
constexpr const char* pad_name(Side side) {
  return side == Side::kLeft ? "sink_left" : "sink_right";
}

}  // namespace mtstereo::plugin
