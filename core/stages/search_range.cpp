// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/search_range.hpp"

#include <algorithm>
#include <cmath>

#include "mtstereo/image.hpp"

namespace mtstereo {
namespace {

struct Range {
  std::uint16_t low;
  std::uint16_t high;
};

/// What is expected where the surfaces lie between two disparities, in 1 / kDisparityOne px.
Range range_around(std::int32_t nearest_zero, std::int32_t farthest_zero,
                   const SearchRangeOptions& options) {
  const double smallest = static_cast<double>(nearest_zero) / kDisparityOne;
  const double largest = static_cast<double>(farthest_zero) / kDisparityOne;
  const double below = smallest - std::max(smallest * options.range, 1.0 * kMinSearch);
  const double above = largest + std::max(largest * options.range, 1.0 * kMinSearch);
  return {static_cast<std::uint16_t>(std::max(static_cast<int>(std::ceil(below)), 0)),
          static_cast<std::uint16_t>(
              std::min(static_cast<int>(std::floor(above)), options.disparities - 1))};
}

}  // namespace

void find_search_ranges(const std::int32_t* nodes, int width, const SearchRangeOptions& options,
                        std::uint16_t* low, std::uint16_t* high) {
  const bool all = options.between_nodes == BetweenNodes::kAll;
  const Range none = {1, 0};
  const Range open = all ? Range{0, static_cast<std::uint16_t>(options.disparities - 1)} : none;
  int last = -1;  // the last column with a node
  for (int x = 0; x < width; ++x) {
    const std::int32_t node = nodes[x];
    Range range = open;
    if (node != kNoDisparity) {
      if (options.between_nodes == BetweenNodes::kSpan && last >= 0 && last + 1 < x) {
        const Range span =
            range_around(std::min(nodes[last], node), std::max(nodes[last], node), options);
        std::fill(low + last + 1, low + x, span.low);
        std::fill(high + last + 1, high + x, span.high);
      }
      range = range_around(node, node, options);
      last = x;
    }
    low[x] = range.low;
    high[x] = range.high;
  }
}

}  // namespace mtstereo
