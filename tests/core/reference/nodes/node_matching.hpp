// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <limits>

#include "reference/nodes/pair_cost.hpp"
#include "stages/nodes/node_matching.hpp"

namespace mtstereo::reference {

/// The disparities of a left node at its two ends; both -1 if it is unmatched.
struct Match {
  int begin = -1;
  int end = -1;

  friend bool operator==(const Match&, const Match&) = default;
};
using Matches = std::vector<std::vector<Match>>;

/// The columns in which the partner of a node may lie; none if first > last.
struct Interval {
  int first, last;
};
using Intervals = std::vector<std::vector<Interval>>;

inline Intervals first_intervals(const Level& left, int disparities) {
  Intervals intervals;
  for (const auto& row : left) {
    intervals.emplace_back();
    for (const LevelNode& node : row) {
      intervals.back().push_back({node.begin - disparities, node.end});
    }
  }
  return intervals;
}

inline Intervals finer_intervals(const Level& left, const Level& before, const Matches& matches,
                                 int most) {
  Intervals intervals;
  for (int y = 0; y < static_cast<int>(left.size()); ++y) {
    intervals.emplace_back();
    for (const LevelNode& node : left[y]) {
      Interval interval{1, 0};
      for (int p = 0; p < static_cast<int>(before[y].size()); ++p) {
        const LevelNode& ancestor = before[y][p];
        if (ancestor.begin > node.begin || ancestor.end < node.end) continue;
        std::vector<int> begins, ends;
        for (const Place& place : surroundings(before, {y, p}, most)) {
          if (matches[place.y][place.i].begin < 0) continue;
          begins.push_back(matches[place.y][place.i].begin);
          ends.push_back(matches[place.y][place.i].end);
        }
        if (begins.empty()) continue;
        interval = {ancestor.begin - lower_median(begins, 0), ancestor.end - lower_median(ends, 0)};
      }
      intervals.back().push_back(interval);
    }
  }
  return intervals;
}

/// Mean cost of a pair and of the pairs of their neighbors at equal distance; pairs with impossible
/// disparities do not count. Adds in the order of the library: the pair, upwards, downwards.
inline float aggregated_cost(const PairInput& input, int most, int disparities, int y, int i,
                             int j) {
  float sum = pair_cost<float>(input, y, i, j);
  int count = 1;
  for (const int direction : {-1, 1}) {
    const std::vector<Place> lefts = neighbors(input.left, {y, i}, direction, most);
    const std::vector<Place> rights = neighbors(input.right, {y, j}, direction, most);
    for (std::size_t k = 0; k < std::min(lefts.size(), rights.size()); ++k) {
      const auto [row, l] = lefts[k];
      const int r = rights[k].i;
      if (!ends(input.left[row][l], input.right[row][r]).possible(disparities)) continue;
      sum += pair_cost<float>(input, row, l, r);
      ++count;
    }
  }
  return sum / static_cast<float>(count);
}

/// The partner of least cost, and whether it is acceptable: all others cost more than (1 +
/// confidence) times as much.
struct Choice {
  int partner = -1;
  bool clear = false;
};

inline Choice choose(const std::vector<float>& costs, float confidence) {
  Choice choice;
  const auto best = std::min_element(costs.begin(), costs.end());
  if (best == costs.end() || std::isinf(*best)) return choice;
  choice.partner = static_cast<int>(best - costs.begin());
  choice.clear = true;
  for (auto other = costs.begin(); other != costs.end(); ++other) {
    if (other != best && !(*other > *best * (1 + confidence))) choice.clear = false;
  }
  return choice;
}

/// Costs of all pairs of one row; infinite for pairs that cannot match.
inline std::vector<std::vector<float>> cost_table(const PairInput& input,
                                                  const Intervals& intervals, int most,
                                                  int disparities, int y) {
  const float impossible = std::numeric_limits<float>::infinity();
  std::vector<std::vector<float>> costs;
  for (int i = 0; i < static_cast<int>(input.left[y].size()); ++i) {
    costs.emplace_back(input.right[y].size(), impossible);
    const Interval& interval = intervals[y][i];
    for (int j = 0; j < static_cast<int>(input.right[y].size()); ++j) {
      const LevelNode& right = input.right[y][j];
      if (!ends(input.left[y][i], right).possible(disparities)) continue;
      if (right.begin < interval.first || right.end > interval.last) continue;
      costs[i][j] = aggregated_cost(input, most, disparities, y, i, j);
    }
  }
  return costs;
}

inline Matches match_nodes(const PairInput& input, const Intervals& intervals, int most,
                           int disparities, float confidence, int width) {
  const auto at_border = [&](const LevelNode& node) {
    return node.begin == 0 || node.end == width - 1;
  };
  Matches matches;
  for (int y = 0; y < static_cast<int>(input.left.size()); ++y) {
    matches.emplace_back(input.left[y].size());
    const auto costs = cost_table(input, intervals, most, disparities, y);
    for (int i = 0; i < static_cast<int>(costs.size()); ++i) {
      const Choice forth = choose(costs[i], confidence);
      if (!forth.clear) continue;
      std::vector<float> column;
      for (const auto& row : costs) column.push_back(row[forth.partner]);
      const Choice back = choose(column, confidence);
      const LevelNode& left = input.left[y][i];
      const LevelNode& right = input.right[y][forth.partner];
      if (!back.clear || back.partner != i || at_border(left) || at_border(right)) continue;
      matches[y][i] = {left.begin - right.begin, left.end - right.end};
    }
  }
  return matches;
}

}  // namespace mtstereo::reference
