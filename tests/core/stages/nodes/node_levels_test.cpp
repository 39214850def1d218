// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/nodes/node_levels.hpp"

#include <gtest/gtest.h>

#include "reference/nodes/node_levels.hpp"
#include "support/stages.hpp"

namespace mtstereo::node_levels_test {
namespace {

using Columns = std::vector<std::pair<int, int>>;

Columns columns(const NodeLevel& level, int y) {
  Columns list;
  for (int i = 0; i < level.count[y]; ++i) {
    list.emplace_back(level.begin[level.first[y] + i], level.end[level.first[y] + i]);
  }
  return list;
}

Columns columns(const reference::Level& level, int y) {
  Columns list;
  for (const reference::LevelNode& node : level[y]) list.emplace_back(node.begin, node.end);
  return list;
}

void expect_nodes(const GrayPlane& levels, const MaxTrees& trees, const reference::Level& expected,
                  const NodeLevel& level) {
  for (int y = 0; y < levels.height; ++y) {
    ASSERT_EQ(columns(expected, y), columns(level, y))
        << "row " << y << ": "
        << testing::PrintToString(std::vector<int>(&levels(0, y), &levels(0, y) + levels.width));
    for (int i = 0; i < level.count[y]; ++i) {
      const std::ptrdiff_t at = level.first[y] + i;
      const std::ptrdiff_t node = trees.first[y] + level.node[at];
      EXPECT_EQ(level.begin[at], trees.begin[node]) << "row " << y << ", node " << i;
      EXPECT_EQ(level.end[at], trees.end[node]) << "row " << y << ", node " << i;
    }
  }
  for (int y = 0; y < levels.height; ++y) {
    CoveringNode covering(level, y);
    for (int x = 0; x < levels.width; ++x) {
      const int node = covering.at(x);
      ASSERT_EQ(reference::covering(expected, y, x), node == kNoNode ? -1 : node)
          << "at (" << x << ", " << y << ")";
    }
  }
}

void expect_links(const reference::Level& expected, const NodeLevel& level) {
  const auto index = [](std::uint16_t node) {
    return node == kNoNode ? -1 : static_cast<int>(node);
  };
  for (int y = 0; y < level.height; ++y) {
    for (int i = 0; i < level.count[y]; ++i) {
      const std::ptrdiff_t at = level.first[y] + i;
      const int center = expected[y][i].center();
      EXPECT_EQ(reference::covering(expected, y - 1, center), index(level.up[at]))
          << "above node " << i << " of row " << y;
      EXPECT_EQ(reference::covering(expected, y + 1, center), index(level.down[at]))
          << "below node " << i << " of row " << y;
    }
  }
}

void expect_reference(const GrayPlane& levels, int ancestor, WidthRange widths,
                      int band = 1 << 20) {
  SCOPED_TRACE(testing::Message() << levels.width << "x" << levels.height << ", ancestor "
                                  << ancestor << ", widths " << widths.above << " to "
                                  << widths.below);
  const MaxTrees trees = test::trees_of(levels);
  const NodeLevel level = test::level_of(trees, ancestor, widths, band);
  const reference::Level expected =
      reference::select_nodes(reference::max_trees(levels), ancestor, widths.above, widths.below);
  expect_nodes(levels, trees, expected, level);
  if (!testing::Test::HasFatalFailure()) expect_links(expected, level);
}

TEST(NodeLevels, EqualReferenceForEveryShortRow) {
  for (int width = 1; width <= 7; ++width) {
    const GrayPlane levels = test::all_rows(width, 3);
    for (int ancestor = 0; ancestor <= 3; ++ancestor) expect_reference(levels, ancestor, {0, 1e9});
  }
}

TEST(NodeLevels, EqualReferenceAtEveryWidth) {
  for (int width = 1; width <= 70; ++width) {
    const GrayPlane levels = test::runs(width, 9, width, 7);
    for (const int ancestor : {0, 1, 2, 5}) {
      expect_reference(levels, ancestor, {0, 0.5 * width});
      expect_reference(levels, ancestor, {1, 1e9});
    }
  }
}

TEST(NodeLevels, EqualReferenceOnWideRows) {
  expect_reference(test::runs(8192, 2, 1, 7, 40), 1, {0, 4096});
}

TEST(NodeLevels, DoNotDependOnBands) {
  const GrayPlane levels = test::runs(90, 40, 2, 5);
  for (const int band : {1, 3, 32, 39}) expect_reference(levels, 1, {0, 45}, band);
}

TEST(NodeLevels, ContainLeavesStrictlyBetweenTheWidths) {
  GrayPlane levels(40, 1);
  for (int x = 2; x < 5; ++x) levels(x, 0) = 1;    // 3 px
  for (int x = 10; x < 14; ++x) levels(x, 0) = 1;  // 4 px
  for (int x = 20; x < 25; ++x) levels(x, 0) = 1;  // 5 px
  const MaxTrees trees = test::trees_of(levels);
  EXPECT_EQ((Columns{{10, 13}}), columns(test::level_of(trees, 0, {3, 5}), 0));
  EXPECT_EQ((Columns{{2, 4}, {10, 13}}), columns(test::level_of(trees, 0, {2, 5}), 0));
  EXPECT_EQ((Columns{{2, 4}, {10, 13}, {20, 24}}), columns(test::level_of(trees, 0, {2, 5.5}), 0));
  EXPECT_EQ(Columns{}, columns(test::level_of(trees, 0, {5, 40}), 0));
}

TEST(NodeLevels, ContainEachNodeOnce) {
  // Leaves of one ancestor and between them leaves of another, higher one.
  GrayPlane levels(21, 1);
  const std::vector<int> row = {0, 1, 2, 3, 2, 1, 2, 1, 2, 3, 2, 1, 2, 1, 2, 3, 2, 1, 0, 1, 0};
  std::copy(row.begin(), row.end(), levels.pixels.begin());
  const MaxTrees trees = test::trees_of(levels);
  EXPECT_EQ((Columns{{1, 17}}), columns(test::level_of(trees, 2, test::kAnyWidth), 0));
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const GrayPlane random = test::runs(200, 10, seed, 7, 2);
    for (int ancestor = 0; ancestor <= 6; ++ancestor) {
      expect_reference(random, ancestor, test::kAnyWidth);
    }
  }
}

TEST(NodeLevels, NeverNest) {
  const GrayPlane levels = test::runs(400, 40, 3, 15, 3);
  const MaxTrees trees = test::trees_of(levels);
  for (int ancestor = 0; ancestor <= 8; ++ancestor) {
    const NodeLevel level = test::level_of(trees, ancestor, test::kAnyWidth);
    for (int y = 0; y < levels.height; ++y) {
      const Columns nodes = columns(level, y);
      for (std::size_t i = 1; i < nodes.size(); ++i) {
        EXPECT_GT(nodes[i].first, nodes[i - 1].second + 1)
            << "row " << y << ", node " << i << ", ancestor " << ancestor;
      }
    }
  }
}

TEST(NodeLevels, AreEmptyWithoutAncestors) {
  const NodeLevel none = test::level_of(test::trees_of(GrayPlane(30, 3, 4)), 1, test::kAnyWidth);
  for (int y = 0; y < 3; ++y) EXPECT_EQ(0, none.count[y]) << "the root has no parent";
}

}  // namespace
}  // namespace mtstereo::node_levels_test
