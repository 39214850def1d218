// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/nodes/node_matching.hpp"

#include <algorithm>
#include <limits>

#include "stages/nodes/neighbors.hpp"

namespace mtstereo {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

using Best = MatchScratch::Best;

void offer(Best& best, float cost, int partner) {
  if (cost < best.cost) {
    best = {cost, best.cost, partner};
  } else {
    best.second = std::min(best.second, cost);
  }
}

bool accepted(const Best& best, float confidence) {
  return best.second > best.cost * (1 + confidence) && best.cost < kInfinity;
}

/// Sum and number of the costs along a chain of pairs in adjacent rows.
struct ChainSum {
  float sum = 0;
  int pairs = 0;
};

/// Adds up to `max_neighbors` neighbors in one direction, until one of the two chains ends. Pairs
/// with impossible disparities are skipped.
void add_chain(const PairCostInput& input, const Buffer<std::uint16_t>& left_link,
               const Buffer<std::uint16_t>& right_link, int direction, int max_neighbors, int y,
               int i, int j, PairCosts& costs, ChainSum& chain) {
  for (int step = 0; step < max_neighbors; ++step) {
    const std::uint16_t l = left_link[input.left.first[y] + i];
    const std::uint16_t r = right_link[input.right.first[y] + j];
    if (l == kNoNode || r == kNoNode) return;
    y += direction;
    i = l;
    j = r;
    const float cost = costs(y, i, j);
    if (cost < 0) continue;
    chain.sum += cost;
    ++chain.pairs;
  }
}

/// Mean cost of a pair and its neighbors.
float aggregated_cost(const PairCostInput& input, int max_neighbors, int y, int i, int j,
                      PairCosts& costs) {
  ChainSum chain{costs(y, i, j), 1};
  add_chain(input, input.left.up, input.right.up, -1, max_neighbors, y, i, j, costs, chain);
  add_chain(input, input.left.down, input.right.down, 1, max_neighbors, y, i, j, costs, chain);
  return chain.sum / static_cast<float>(chain.pairs);
}

/// Whether a node touches the left or right border of the view.
bool at_border(const NodeLevel& level, std::ptrdiff_t node) {
  return level.begin[node] == 0 || level.end[node] == level.width - 1;
}

}  // namespace

void NodeMatches::resize(const NodeLevel& left) {
  begin_disparity.resize(left.size());
  end_disparity.resize(left.size());
}

void SearchIntervals::resize(const NodeLevel& left) {
  first.resize(left.size());
  last.resize(left.size());
}

void IntervalScratch::resize(int width) {
  first.resize(most_leaves(width));
  last.resize(most_leaves(width));
}

void MatchScratch::resize(int width, int disparities, int max_neighbors) {
  costs.resize(width, disparities, max_neighbors);
  left.resize(most_leaves(width));
  right.resize(most_leaves(width));
}

void first_intervals(const NodeLevel& left, int disparities, int y0, int y1,
                     SearchIntervals& intervals) {
  for (int y = y0; y < y1; ++y) {
    const std::ptrdiff_t row = left.first[y];
    for (int i = 0; i < left.count[y]; ++i) {
      intervals.first[row + i] = left.begin[row + i] - disparities;
      intervals.last[row + i] = left.end[row + i];
    }
  }
}

void finer_intervals(const NodeLevel& left, const NodeLevel& before, const NodeMatches& matches,
                     int max_neighbors, int y0, int y1, IntervalScratch& scratch,
                     SearchIntervals& intervals) {
  scratch.resize(before.width);
  std::int32_t* first = scratch.first.data();
  std::int32_t* last = scratch.last.data();
  for (int y = y0; y < y1; ++y) {
    for (int p = 0; p < before.count[y]; ++p) {
      const std::ptrdiff_t node = before.first[y] + p;
      const EndMedians median =
          medians_over_neighbors(before, y, p, max_neighbors, matches.begin_disparity.data(),
                                 matches.end_disparity.data(), kNodeUnmatched);
      const bool found = median.begin != kNodeUnmatched;
      first[p] = found ? before.begin[node] - median.begin : 1;
      last[p] = found ? before.end[node] - median.end : 0;
    }
    CoveringNode ancestor(before, y);
    for (int i = 0; i < left.count[y]; ++i) {
      const std::ptrdiff_t node = left.first[y] + i;
      // Nodes nest, so the coarser level's node that covers the center is an ancestor.
      const std::uint16_t p = ancestor.at((left.begin[node] + left.end[node]) / 2);
      intervals.first[node] = p == kNoNode ? 1 : first[p];
      intervals.last[node] = p == kNoNode ? 0 : last[p];
    }
  }
}

void match_nodes(const PairCostInput& input, const SearchIntervals& intervals, int max_neighbors,
                 float confidence, int y0, int y1, MatchScratch& scratch, NodeMatches& matches) {
  const NodeLevel& left = input.left;
  const NodeLevel& right = input.right;
  scratch.costs.start(input);
  for (int y = y0; y < y1; ++y) {
    scratch.costs.move_to(y);
    const std::ptrdiff_t left_row = left.first[y];
    const std::ptrdiff_t right_row = right.first[y];
    std::fill_n(scratch.left.data(), left.count[y], Best{kInfinity, kInfinity, -1});
    std::fill_n(scratch.right.data(), right.count[y], Best{kInfinity, kInfinity, -1});
    for (int i = 0; i < left.count[y]; ++i) {
      const std::int32_t first = intervals.first[left_row + i];
      const std::int32_t last = intervals.last[left_row + i];
      if (first > last) continue;
      const PairCosts::Candidates range = scratch.costs.candidates(y, i);
      for (int j = range.first; j < range.last; ++j) {
        if (right.begin[right_row + j] < first || right.end[right_row + j] > last) continue;
        const float cost = aggregated_cost(input, max_neighbors, y, i, j, scratch.costs);
        offer(scratch.left[i], cost, j);
        offer(scratch.right[j], cost, i);
      }
    }
    for (int i = 0; i < left.count[y]; ++i) {
      const Best& best = scratch.left[i];
      std::int16_t begin = kNodeUnmatched;
      std::int16_t end = kNodeUnmatched;
      if (best.partner >= 0) {
        const Best& back = scratch.right[best.partner];
        const std::ptrdiff_t l = left_row + i;
        const std::ptrdiff_t r = right_row + best.partner;
        if (back.partner == i && accepted(best, confidence) && accepted(back, confidence) &&
            !at_border(left, l) && !at_border(right, r)) {
          begin = static_cast<std::int16_t>(left.begin[l] - right.begin[r]);
          end = static_cast<std::int16_t>(left.end[l] - right.end[r]);
        }
      }
      matches.begin_disparity[left_row + i] = begin;
      matches.end_disparity[left_row + i] = end;
    }
  }
}

}  // namespace mtstereo
