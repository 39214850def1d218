// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixels/search_range.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "reference/pixels/search_range.hpp"
#include "support/random.hpp"
#include "support/simd_targets.hpp"

namespace mtstereo {
namespace {

using test::Random;
using Row = std::vector<std::int32_t>;

struct Range {
  int low, high;
  bool none() const { return low > high; }
};

std::vector<Range> ranges_of(const Row& nodes, const SearchRangeOptions& options) {
  const int width = static_cast<int>(nodes.size());
  std::vector<std::uint16_t> low(width, 0x5A5A), high(width, 0x5A5A);
  find_search_ranges(nodes.data(), width, options, low.data(), high.data());
  std::vector<Range> ranges;
  for (int x = 0; x < width; ++x) ranges.push_back({low[x], high[x]});
  return ranges;
}

void expect_reference(const Row& nodes, const SearchRangeOptions& options) {
  const std::vector<Range> actual = ranges_of(nodes, options);
  for (int x = 0; x < static_cast<int>(nodes.size()); ++x) {
    const std::vector<int> expected = reference::expected_disparities(nodes, x, options);
    SCOPED_TRACE(testing::Message()
                 << "column " << x << " of " << nodes.size() << ", node " << nodes[x] << ", range "
                 << options.range << ", D " << options.disparities << ", between "
                 << static_cast<int>(options.between_nodes));
    if (expected.empty()) {
      EXPECT_TRUE(actual[x].none()) << actual[x].low << " .. " << actual[x].high;
    } else {
      EXPECT_EQ(expected.front(), actual[x].low);
      EXPECT_EQ(expected.back(), actual[x].high);
    }
  }
}

/// Nodes of several pixels each, with gaps between them.
Row random_nodes(int width, int disparities, Random& random) {
  Row nodes(width);
  for (int x = 0; x < width;) {
    const bool known = random.below(2) == 0;
    const int disparity = random.between(1, 256 * disparities - 1);
    for (int n = random.between(1, 6); n > 0 && x < width; --n) nodes[x++] = known ? disparity : 0;
  }
  return nodes;
}

constexpr BetweenNodes kAllWays[] = {BetweenNodes::kNone, BetweenNodes::kSpan, BetweenNodes::kAll};

TEST(SearchRange, EqualsReferenceAtEveryWidthOnEveryInstructionSet) {
  test::for_each_simd_target([] {
    for (int width = 1; width <= 70; ++width) {
      Random random(width);
      for (const BetweenNodes between : kAllWays) {
        for (const double range : {0.0, 0.15, 0.6, 1.0}) {
          const int disparities = random.between(1, 90);
          expect_reference(random_nodes(width, disparities, random), {range, between, disparities});
        }
      }
    }
  });
}

TEST(SearchRange, RoundsTheEndsInwardsForEveryDisparity) {
  constexpr int kDisparities = 1984;
  Row nodes;
  for (int disparity = 1; disparity < 256 * kDisparities; ++disparity) nodes.push_back(disparity);
  test::for_each_simd_target([&] {
    for (const double range : {0.0, 0.05, 0.1, 0.15, 0.2, 0.25, 1.0 / 3, 0.7, 1.0}) {
      const std::vector<Range> ranges =
          ranges_of(nodes, {range, BetweenNodes::kNone, kDisparities});
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const double disparity = nodes[i] / 256.0;
        const double reach = std::max(disparity * range, 3.0);
        ASSERT_EQ(std::max(std::ceil(disparity - reach), 0.0), ranges[i].low) << nodes[i];
        ASSERT_EQ(std::min(std::floor(disparity + reach), kDisparities - 1.0), ranges[i].high)
            << nodes[i];
      }
    }
  });
}

TEST(SearchRange, WritesNothingAfterTheRow) {
  test::for_each_simd_target([] {
    for (int width = 1; width <= 20; ++width) {
      const Row nodes(width, 2560);
      std::vector<std::uint16_t> low(width + 1, 0x5A5A), high(width + 1, 0x5A5A);
      find_search_ranges(nodes.data(), width, {0.15, BetweenNodes::kSpan, 40}, low.data(),
                         high.data());
      EXPECT_EQ(0x5A5A, low[width]) << width;
      EXPECT_EQ(0x5A5A, high[width]) << width;
    }
  });
}

TEST(SearchRange, EqualsReferenceWithTheLargestNumberOfDisparities) {
  Random random(1);
  for (const BetweenNodes between : kAllWays) {
    for (const double range : {0.0, 0.15, 1.0}) {
      expect_reference(random_nodes(200, 1984, random), {range, between, 1984});
    }
  }
}

TEST(SearchRange, ReachesAFewPixelsAroundSmallDisparities) {
  for (const auto& [disparity, low, high] : {std::tuple{1, 0, 3},
                                             {256 * 2, 0, 5},
                                             {256 * 10, 7, 13},
                                             {256 * 10 + 1, 8, 13},
                                             {256 * 10 - 1, 7, 12},
                                             {256 * 20, 17, 23},
                                             {256 * 40, 34, 46}}) {
    const Range range = ranges_of({disparity}, {0.15, BetweenNodes::kNone, 64})[0];
    EXPECT_EQ(low, range.low) << disparity;
    EXPECT_EQ(high, range.high) << disparity;
  }
}

TEST(SearchRange, EndsAtTheLargestDisparity) {
  const Range range = ranges_of({256 * 39}, {1.0, BetweenNodes::kNone, 40})[0];
  EXPECT_EQ(0, range.low);
  EXPECT_EQ(39, range.high);
}

TEST(SearchRange, IsEmptyWithoutNodesUnlessAllDisparitiesAreExpected) {
  const Row none(30);
  for (const Range& range : ranges_of(none, {0.15, BetweenNodes::kNone, 40})) {
    EXPECT_TRUE(range.none());
  }
  for (const Range& range : ranges_of(none, {0.15, BetweenNodes::kSpan, 40})) {
    EXPECT_TRUE(range.none());
  }
  for (const Range& range : ranges_of(none, {0.15, BetweenNodes::kAll, 40})) {
    EXPECT_EQ(0, range.low);
    EXPECT_EQ(39, range.high);
  }
}

TEST(SearchRange, SpansTheNodesOnBothSides) {
  Row nodes(12);
  nodes[3] = 256 * 10;
  nodes[7] = 256 * 30;
  const std::vector<Range> ranges = ranges_of(nodes, {0.1, BetweenNodes::kSpan, 64});
  for (int x = 0; x < 12; ++x) {
    if (x < 3 || x > 7) {
      EXPECT_TRUE(ranges[x].none()) << "column " << x << " has a node on one side only";
    } else {
      EXPECT_EQ(x == 7 ? 27 : 7, ranges[x].low) << "column " << x;
      EXPECT_EQ(x == 3 ? 13 : 33, ranges[x].high) << "column " << x;
    }
  }
}

}  // namespace
}  // namespace mtstereo
