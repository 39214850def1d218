// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <cstring>

#include "mtstereo/image.hpp"

/// Internal to search_range.cpp: what the kernels of all SIMD targets share.

namespace mtstereo {

/// Pixels that are processed together.
inline constexpr int kRangeBlock = 8;

/// The disparities low .. high [px].
struct SearchRange {
  std::uint16_t low, high;
};

/// Whether any of kRangeBlock pixels has a node's disparity.
inline bool has_node(const std::int32_t* nodes) {
  static_assert(kNoDisparity == 0);
  std::uint64_t pairs[kRangeBlock / 2];
  std::memcpy(pairs, nodes, sizeof(pairs));
  return (pairs[0] | pairs[1] | pairs[2] | pairs[3]) != 0;
}

}  // namespace mtstereo
