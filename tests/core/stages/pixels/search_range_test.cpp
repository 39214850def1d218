// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixels/search_range.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "reference/pixels/search_range.hpp"
#include "support/random.hpp"
#include "support/simd_targets.hpp"

namespace mtstereo::search_range_test {
namespace {

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
                 << options.range << ", D " << options.disparities);
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

TEST(SearchRange, EqualsReferenceAtEveryWidthOnEveryInstructionSet) {
  test::for_each_simd_target([] {
    for (int width = 1; width <= 70; ++width) {
      Random random(width);
      for (const double range : {0.0, 0.15, 0.6, 1.0}) {
        const int disparities = random.between(1, 90);
        expect_reference(random_nodes(width, disparities, random), {range, disparities});
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
      const std::vector<Range> ranges = ranges_of(nodes, {range, kDisparities});
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
      find_search_ranges(nodes.data(), width, {0.15, 40}, low.data(), high.data());
      EXPECT_EQ(0x5A5A, low[width]) << width;
      EXPECT_EQ(0x5A5A, high[width]) << width;
    }
  });
}

TEST(SearchRange, EqualsReferenceWithTheLargestNumberOfDisparities) {
  Random random(1);
  for (const double range : {0.0, 0.15, 1.0}) {
    expect_reference(random_nodes(200, 1984, random), {range, 1984});
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
    const Range range = ranges_of({disparity}, {0.15, 64})[0];
    EXPECT_EQ(low, range.low) << disparity;
    EXPECT_EQ(high, range.high) << disparity;
  }
}

TEST(SearchRange, EndsAtTheLargestDisparity) {
  const Range range = ranges_of({256 * 39}, {1.0, 40})[0];
  EXPECT_EQ(0, range.low);
  EXPECT_EQ(39, range.high);
}

TEST(SearchRange, IsEmptyWithoutNodes) {
  for (const Range& range : ranges_of(Row(30), {0.15, 40})) EXPECT_TRUE(range.none());
}

}  // namespace
}  // namespace mtstereo::search_range_test
