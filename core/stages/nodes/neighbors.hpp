// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "base/limits.hpp"
#include "stages/nodes/node_levels.hpp"

namespace mtstereo {

/// Largest number of values that a node and its neighbors above and below can have.
inline constexpr int kMaxChain = 2 * kLargestNeighbors + 1;

/// Collects the values of a node and its neighbors and finds their median.
class ChainValues {
 public:
  void add(std::int32_t value, bool counts) {
    values_[count_] = value;
    count_ += counts;
  }

  /// The median; the lower of the middle two if their number is even, `none` if there are no
  /// values.
  std::int32_t lower_median(std::int32_t none) {
    if (count_ == 0) return none;
    // Whole blocks are compared at once; the last one is padded with a number above all values.
    const int blocks = (count_ + kBlock - 1) / kBlock;
    std::fill_n(values_ + count_, kBlock, std::numeric_limits<std::int32_t>::max());
    const int wanted = (count_ - 1) / 2;
    // The median lies between these bounds. Most values of a chain are similar, so that few values
    // have to be ranked.
    std::int32_t below = std::numeric_limits<std::int32_t>::min();
    std::int32_t above = std::numeric_limits<std::int32_t>::max();
    for (int i = 0;; ++i) {
      const std::int32_t value = values_[i];
      if (value <= below || value >= above) continue;
      int less = 0;
      int not_above = 0;
      for (int block = 0; block < blocks; ++block) {
        for (int k = 0; k < kBlock; ++k) {
          less += values_[block * kBlock + k] < value;
          not_above += values_[block * kBlock + k] <= value;
        }
      }
      if (wanted < less) {
        above = value;
      } else if (wanted >= not_above) {
        below = value;
      } else {
        return value;
      }
    }
  }

 private:
  static constexpr int kBlock = 8;
  std::int32_t values_[kMaxChain + kBlock];
  int count_ = 0;
};

/// Two medians: of the values at the first and at the last columns of nodes.
struct EndMedians {
  std::int32_t begin;
  std::int32_t end;
};

/// The medians of the values of node i of row y, of up to `max_neighbors` neighbors above it and of
/// as many below it. Values equal to `none` are ignored; the median of no values is `none`.
/// `begins` and `ends` have the layout of the level's per-node arrays. No value is the smallest or
/// the largest 32-bit integer.
template <typename T>
EndMedians medians_over_neighbors(const NodeLevel& level, int y, int i, int max_neighbors,
                                  const T* begins, const T* ends, T none) {
  ChainValues at_begin;
  ChainValues at_end;
  const auto take = [&](std::size_t node) {
    at_begin.add(begins[node], begins[node] != none);
    at_end.add(ends[node], ends[node] != none);
  };
  take(level.first[y] + i);
  const auto walk = [&](const std::uint16_t* link, int direction) {
    int row = y;
    std::uint16_t next = link[level.first[row] + i];
    for (int step = 0; step < max_neighbors && next != kNoNode; ++step) {
      row += direction;
      const std::size_t node = level.first[row] + next;
      take(node);
      next = link[node];
    }
  };
  walk(level.up.data(), -1);
  walk(level.down.data(), 1);
  return {at_begin.lower_median(none), at_end.lower_median(none)};
}

}  // namespace mtstereo
