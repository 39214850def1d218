// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>

#include "stages/pixels/search_range.hpp"
#include "support/plane.hpp"

namespace mtstereo::reference {

/// The range of the disparities of the nodes that a pixel lies on or between, in px.
struct Surfaces {
  double smallest, largest;
};

/// The surfaces at a pixel of a row: those of its own node or of the nearest nodes on both sides.
inline std::optional<Surfaces> surfaces_at(const std::vector<std::int32_t>& nodes, int x,
                                           BetweenNodes between) {
  if (nodes[x] != 0) return Surfaces{nodes[x] / 256.0, nodes[x] / 256.0};
  if (between != BetweenNodes::kSpan) return {};
  int before = x, after = x;
  const int width = static_cast<int>(nodes.size());
  while (before >= 0 && nodes[before] == 0) --before;
  while (after < width && nodes[after] == 0) ++after;
  if (before < 0 || after == width) return {};
  const auto [least, most] = std::minmax(nodes[before], nodes[after]);
  return Surfaces{least / 256.0, most / 256.0};
}

/// The expected disparities of one pixel of a row in increasing order; empty if none are expected.
inline std::vector<int> expected_disparities(const std::vector<std::int32_t>& nodes, int x,
                                             const SearchRangeOptions& options) {
  const std::optional<Surfaces> surfaces = surfaces_at(nodes, x, options.between_nodes);
  std::vector<int> expected;
  for (int d = 0; d < options.disparities; ++d) {
    if (!surfaces) {
      if (options.between_nodes == BetweenNodes::kAll) expected.push_back(d);
      continue;
    }
    const double below = std::max(surfaces->smallest * options.range, 3.0);
    const double above = std::max(surfaces->largest * options.range, 3.0);
    if (d >= surfaces->smallest - below && d <= surfaces->largest + above) expected.push_back(d);
  }
  return expected;
}

}  // namespace mtstereo::reference
