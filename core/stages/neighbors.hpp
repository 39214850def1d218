// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>

#include "stages/node_levels.hpp"

namespace mtstereo {

/// Largest number of values that a node and its neighbors above and below can have.
inline constexpr int kMaxChain = 2 * 100 + 1;

/// The median (of an even number the lower of the middle two) of a value of node i of row y and of
/// its up to `max_neighbors` neighbors above and as many below; those whose value is `none` do not
/// count. Returns `none` where none counts. `values` is laid out as the level's columns are.
template <typename T>
T median_over_neighbors(const NodeLevel& level, int y, int i, int max_neighbors, const T* values,
                        T none) {
  T found[kMaxChain];
  int count = 0;
  const auto take = [&](int row, int node) {
    const T value = values[level.first[row] + node];
    if (value != none) found[count++] = value;
  };
  take(y, i);
  const auto walk = [&](const Buffer<std::uint16_t>& link, int direction) {
    int row = y;
    std::uint16_t node = link[level.first[row] + i];
    for (int step = 0; step < max_neighbors && node != kNoNode; ++step) {
      row += direction;
      take(row, node);
      node = link[level.first[row] + node];
    }
  };
  walk(level.up, -1);
  walk(level.down, 1);
  if (count == 0) return none;
  T* middle = found + (count - 1) / 2;
  std::nth_element(found, middle, found + count);
  return *middle;
}

}  // namespace mtstereo
