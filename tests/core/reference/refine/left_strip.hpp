// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "reference/refine/gap_filling.hpp"

namespace mtstereo::reference {

/// Marks the doubted pixels of the strip, then fills each from its neighbors.
inline ConfidentMap correct_left_strip(const ConfidentMap& in, int strip) {
  ConfidentMap out = in;
  const int width = in.map.width;
  for (int y = 0; y < in.map.height; ++y) {
    const auto doubted = [&](int x) {
      if (x >= strip || in.confidence(x, y) >= 100) return false;
      int next = x;
      while (next < width && in.confidence(next, y) < 100) ++next;
      return next < width && in.map(x, y) < in.map(next, y) / 2;
    };
    for (int x = 0; x < width; ++x) {
      if (!doubted(x)) continue;
      int left = x, right = x;
      while (left >= 0 && doubted(left)) --left;
      while (doubted(right)) ++right;
      const int after = in.map(right, y);
      out.map(x, y) = left >= 0 ? std::min(in.map(left, y), after) : after;
      out.confidence(x, y) = 1;
    }
  }
  return out;
}

}  // namespace mtstereo::reference
