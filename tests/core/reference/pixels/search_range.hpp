// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <vector>

#include "stages/pixels/search_range.hpp"

namespace mtstereo::reference {

/// The expected disparities of one pixel of a row in increasing order; none without a node.
inline std::vector<int> expected_disparities(const std::vector<std::int32_t>& nodes, int x,
                                             const SearchRangeOptions& options) {
  std::vector<int> expected;
  const double node = nodes[x] / 256.0, reach = std::max(node * options.range, 3.0);
  for (int d = 0; d < options.disparities && nodes[x] != 0; ++d) {
    if (d >= node - reach && d <= node + reach) expected.push_back(d);
  }
  return expected;
}

}  // namespace mtstereo::reference
