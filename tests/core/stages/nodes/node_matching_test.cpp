// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/nodes/node_matching.hpp"

#include <gtest/gtest.h>

#include "reference/nodes/node_matching.hpp"
#include "support/stages.hpp"

namespace mtstereo::node_matching_test {
namespace {

using test::RandomLevels;
using test::RandomVolume;

/// The options of matching one level.
struct Options {
  int disparities;
  int neighbors;
  int shift;
  float alpha;
  float confidence;
  int band = 1 << 20;
};

NodeMatches matches_of(const PairCostInput& input, const SearchIntervals& intervals,
                       const Options& options) {
  NodeMatches matches;
  matches.resize(input.left);
  MatchScratch scratch;
  scratch.resize(input.left.width, options.disparities, options.neighbors);
  for (int y = 0; y < input.left.height; y += options.band) {
    match_nodes(input, intervals, options.neighbors, options.confidence, y,
                std::min(y + options.band, input.left.height), scratch, matches);
  }
  return matches;
}

void expect_intervals(const reference::Intervals& expected, const NodeLevel& left,
                      const SearchIntervals& intervals) {
  for (int y = 0; y < left.height; ++y) {
    for (int i = 0; i < left.count[y]; ++i) {
      const std::ptrdiff_t at = left.first[y] + i;
      const auto [first, last] = expected[y][i];
      if (first > last) {
        ASSERT_GT(intervals.first[at], intervals.last[at]) << "row " << y << ", node " << i;
        continue;
      }
      ASSERT_EQ(first, intervals.first[at]) << "row " << y << ", node " << i;
      ASSERT_EQ(last, intervals.last[at]) << "row " << y << ", node " << i;
    }
  }
}

/// Returns the number of matched nodes; fails if a match differs from that of the reference.
int expect_matches(const reference::Matches& expected, const NodeLevel& left,
                   const NodeMatches& matches) {
  int matched = 0;
  for (int y = 0; y < left.height; ++y) {
    for (int i = 0; i < left.count[y]; ++i) {
      const std::ptrdiff_t at = left.first[y] + i;
      EXPECT_EQ(expected[y][i].begin, matches.begin_disparity[at]) << "row " << y << ", node " << i;
      EXPECT_EQ(expected[y][i].end, matches.end_disparity[at]) << "row " << y << ", node " << i;
      if (expected[y][i].begin >= 0) ++matched;
    }
  }
  return matched;
}

/// Matches the first level with random costs; returns how many nodes were matched.
int expect_first_level(const RandomLevels& levels, const Options& options, std::uint64_t seed) {
  SCOPED_TRACE(testing::Message() << levels.left.width << "x" << levels.left.height << ", "
                                  << options.disparities << " disparities, " << options.neighbors
                                  << " neighbors, bands of " << options.band);
  Random random(seed);
  const RandomVolume volume = test::random_volume(levels.left.width, levels.left.height,
                                                  options.disparities, options.shift, random);
  SearchIntervals intervals;
  intervals.resize(levels.left);
  first_intervals(levels.left, options.disparities, 0, levels.left.height, intervals);
  const reference::Intervals plain_intervals =
      reference::first_intervals(levels.plain_left, options.disparities);
  expect_intervals(plain_intervals, levels.left, intervals);
  const NodeMatches matches = matches_of(levels.input(volume, options.alpha), intervals, options);
  return expect_matches(
      reference::match_nodes(levels.plain_input(volume, options.alpha), plain_intervals,
                             options.neighbors, options.disparities, options.confidence,
                             levels.left.width),
      levels.left, matches);
}

TEST(NodeMatching, EqualsReferenceAtEveryWidth) {
  int matched = 0;
  for (int width = 1; width <= 70; ++width) {
    const Options options{1 + width / 2, width % 4, width % 2, 0.8f, 0.02f};
    matched += expect_first_level(RandomLevels(width, 9, width % 3, 100 + width), options, width);
  }
  EXPECT_GT(matched, 300) << "too few results to compare";
}

TEST(NodeMatching, EqualsReferenceForEveryOption) {
  const RandomLevels levels(90, 25, 0, 7);
  for (const int neighbors : {0, 1, 10, 30}) {
    for (const float confidence : {0.0f, 0.12f, 1.0f}) {
      for (const float alpha : {0.0f, 0.5f, 1.0f}) {
        expect_first_level(levels, {40, neighbors, 1, alpha, confidence}, neighbors + 5);
      }
    }
  }
}

TEST(NodeMatching, DoesNotDependOnBands) {
  const RandomLevels levels(60, 40, 1, 8);
  for (const int band : {1, 2, 7, 32}) {
    EXPECT_GT(expect_first_level(levels, {30, 3, 1, 0.8f, 0.05f, band}, 9), 0);
  }
}

TEST(NodeMatching, EqualsReferenceAtAFinerLevel) {
  int matched = 0;
  for (std::uint64_t seed = 20; seed < 40; ++seed) {
    const GrayPlane left = test::runs(100, 20, seed, 6), right = test::runs(100, 20, seed + 100, 6);
    const int before_ancestor = 1 + static_cast<int>(seed % 3);
    const RandomLevels coarse(left, right, before_ancestor), fine(left, right, 0);
    Random random(seed);
    const Options options{50, 4, 0, 0.8f, 0.02f};
    // Random matches, so that many nodes have an interval.
    NodeMatches before;
    before.resize(coarse.left);
    reference::Matches plain_before;
    for (int y = 0; y < 20; ++y) {
      plain_before.emplace_back(coarse.plain_left[y].size());
      for (int i = 0; i < coarse.left.count[y]; ++i) {
        reference::Match& match = plain_before[y][i];
        if (random.below(3) == 0) match = {random.below(50), random.below(50)};
        before.begin_disparity[coarse.left.first[y] + i] = static_cast<std::int16_t>(match.begin);
        before.end_disparity[coarse.left.first[y] + i] = static_cast<std::int16_t>(match.end);
      }
    }
    SearchIntervals intervals;
    intervals.resize(fine.left);
    IntervalScratch scratch;
    for (int y = 0; y < 20; y += 6) {
      finer_intervals(fine.left, coarse.left, before, options.neighbors, y, std::min(y + 6, 20),
                      scratch, intervals);
    }
    const reference::Intervals plain_intervals = reference::finer_intervals(
        fine.plain_left, coarse.plain_left, plain_before, options.neighbors);
    expect_intervals(plain_intervals, fine.left, intervals);
    const RandomVolume volume = test::random_volume(100, 20, 50, 0, random);
    matched +=
        expect_matches(reference::match_nodes(fine.plain_input(volume, 0.8f), plain_intervals,
                                              options.neighbors, 50, options.confidence, 100),
                       fine.left, matches_of(fine.input(volume, 0.8f), intervals, options));
  }
  EXPECT_GT(matched, 50) << "too few results to compare";
}

/// Rows of 60 px with one leaf [begin, end] each.
GrayPlane one_leaf(int begin, int end, int height = 1) {
  GrayPlane rows(60, height);
  for (int y = 0; y < height; ++y) {
    for (int x = begin; x <= end; ++x) rows(x, y) = 1;
  }
  return rows;
}

/// The disparities of the first node of row 0 with a volume whose costs are all 10 gray values.
reference::Match first_match(const GrayPlane& left, const GrayPlane& right, int disparities) {
  const RandomLevels levels(left, right, 0);
  Random random(1);
  RandomVolume volume = test::random_volume(60, left.height, disparities, 0, random, 0);
  std::fill_n(volume.fast.cells.data(), volume.fast.cells.size(), std::uint16_t{160});
  SearchIntervals intervals;
  intervals.resize(levels.left);
  first_intervals(levels.left, disparities, 0, left.height, intervals);
  const NodeMatches matches =
      matches_of(levels.input(volume, 0.8f), intervals, {disparities, 2, 0, 0.8f, 0.12f});
  return {matches.begin_disparity[0], matches.end_disparity[0]};
}

TEST(NodeMatching, MatchesTheOnlyPair) {
  EXPECT_EQ((reference::Match{7, 5}), first_match(one_leaf(20, 30), one_leaf(13, 25), 20));
}

TEST(NodeMatching, MatchesNodesInTheFirstColumns) {
  EXPECT_EQ((reference::Match{2, 2}), first_match(one_leaf(3, 8), one_leaf(1, 6), 40));
}

TEST(NodeMatching, RejectsNodesAtTheBorder) {
  EXPECT_EQ(reference::Match{}, first_match(one_leaf(0, 8), one_leaf(0, 6), 20)) << "left view";
  EXPECT_EQ(reference::Match{}, first_match(one_leaf(4, 8), one_leaf(0, 6), 20)) << "right view";
  EXPECT_EQ(reference::Match{}, first_match(one_leaf(50, 59), one_leaf(45, 55), 20));
}

TEST(NodeMatching, RejectsDisparitiesOutsideTheRange) {
  EXPECT_EQ((reference::Match{9, 9}), first_match(one_leaf(30, 40), one_leaf(21, 31), 10));
  EXPECT_EQ(reference::Match{}, first_match(one_leaf(30, 40), one_leaf(20, 30), 10)) << "too large";
  EXPECT_EQ((reference::Match{0, 0}), first_match(one_leaf(30, 40), one_leaf(30, 40), 10));
  EXPECT_EQ(reference::Match{}, first_match(one_leaf(30, 40), one_leaf(31, 40), 10)) << "negative";
}

TEST(NodeMatching, RejectsAmbiguousMatches) {
  GrayPlane two = one_leaf(10, 15);
  for (int x = 20; x <= 25; ++x) two(x, 0) = 1;
  EXPECT_EQ(reference::Match{}, first_match(one_leaf(30, 35), two, 40)) << "two right nodes";
  GrayPlane left = one_leaf(30, 35);
  for (int x = 40; x <= 45; ++x) left(x, 0) = 1;
  EXPECT_EQ(reference::Match{}, first_match(left, one_leaf(28, 33), 40)) << "two left nodes";
}

}  // namespace
}  // namespace mtstereo::node_matching_test
