// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/prepare/max_tree.hpp"

#include <gtest/gtest.h>

#include <tuple>

#include "reference/nodes/node_levels.hpp"
#include "support/simd_targets.hpp"
#include "support/stages.hpp"

namespace mtstereo::max_tree_test {
namespace {

/// A node by its columns and those of its parent; (-1, -1) for the parent of the root.
using Outline = std::tuple<int, int, int, int>;

std::vector<Outline> outlines(const MaxTrees& trees, int y) {
  std::vector<Outline> list;
  const std::ptrdiff_t row = trees.first[y];
  for (int i = 0; i < trees.count[y]; ++i) {
    const int parent = trees.parent[row + i];
    list.emplace_back(trees.begin[row + i], trees.end[row + i],
                      parent == kNoNode ? -1 : trees.begin[row + parent],
                      parent == kNoNode ? -1 : trees.end[row + parent]);
  }
  std::sort(list.begin(), list.end());
  return list;
}

std::vector<Outline> outlines(const std::vector<reference::TreeNode>& tree) {
  std::vector<Outline> list;
  for (const reference::TreeNode& node : tree) {
    list.emplace_back(node.begin, node.end, node.parent < 0 ? -1 : tree[node.parent].begin,
                      node.parent < 0 ? -1 : tree[node.parent].end);
  }
  std::sort(list.begin(), list.end());
  return list;
}

/// The columns of the leaves from left to right.
std::vector<std::pair<int, int>> leaves(const MaxTrees& trees, int y) {
  std::vector<std::pair<int, int>> list;
  for (int i = 0; i < trees.leaf_count[y]; ++i) {
    const std::ptrdiff_t node = trees.first[y] + trees.leaf[trees.first_leaf[y] + i];
    list.emplace_back(trees.begin[node], trees.end[node]);
  }
  return list;
}

std::vector<std::pair<int, int>> leaves(const std::vector<reference::TreeNode>& tree) {
  std::vector<std::pair<int, int>> list;
  for (int i = 0; i < static_cast<int>(tree.size()); ++i) {
    if (reference::is_leaf(tree, i)) list.emplace_back(tree[i].begin, tree[i].end);
  }
  std::sort(list.begin(), list.end());
  return list;
}

void expect_reference(const GrayPlane& levels, int band = 1 << 20) {
  const MaxTrees trees = test::trees_of(levels, band);
  for (int y = 0; y < levels.height; ++y) {
    ASSERT_EQ(leaves(reference::max_tree(&levels(0, y), levels.width)), leaves(trees, y))
        << "row " << y << ": "
        << testing::PrintToString(std::vector<int>(&levels(0, y), &levels(0, y) + levels.width));
    ASSERT_EQ(outlines(reference::max_tree(&levels(0, y), levels.width)), outlines(trees, y))
        << "row " << y << ": "
        << testing::PrintToString(std::vector<int>(&levels(0, y), &levels(0, y) + levels.width));
  }
}

TEST(MaxTree, EqualsReferenceForEveryShortRow) {
  for (int width = 1; width <= 6; ++width) expect_reference(test::all_rows(width, 4));
}

TEST(MaxTree, EqualsReferenceAtEveryWidthOnEveryInstructionSet) {
  test::for_each_simd_target([] {
    for (int width = 1; width <= 140; ++width) {
      expect_reference(test::noise(width, 5, width, 15));
      expect_reference(test::runs(width, 5, width, 7));
    }
  });
}

TEST(MaxTree, DoesNotDependOnBands) {
  for (const int band : {1, 3, 32, 39}) expect_reference(test::runs(90, 40, 2, 5), band);
}

TEST(MaxTree, HandlesBandsFullOfNodes) {
  // The largest possible number of leaves, with no free memory between two bands.
  for (int width = 1; width <= 66; ++width) {
    for (const int first : {0, 1}) {
      GrayPlane levels(width, 6);
      for (int x = 0; x < width; ++x) {
        for (int y = 0; y < 6; ++y) levels(x, y) = static_cast<std::uint8_t>((x + first) % 2);
      }
      expect_reference(levels, 2);
    }
  }
}

TEST(MaxTree, PacksTheRowsOfABand) {
  const MaxTrees trees = test::trees_of(test::runs(90, 40, 2, 5), 16);
  for (int y = 1; y < 40; ++y) {
    if (y % 16 == 0) continue;
    EXPECT_EQ(trees.first[y - 1] + trees.count[y - 1], trees.first[y]) << "row " << y;
    EXPECT_EQ(trees.first_leaf[y - 1] + trees.leaf_count[y - 1], trees.first_leaf[y])
        << "row " << y;
  }
}

TEST(MaxTree, EqualsReferenceWithAllLevels) {
  expect_reference(test::noise(301, 4, 1));
  expect_reference(test::runs(301, 4, 2, 255));
}

TEST(MaxTree, EqualsReferenceOnWideRows) { expect_reference(test::runs(8192, 1, 3, 15)); }

TEST(MaxTree, HandlesTheDeepestTrees) {
  GrayPlane levels(512, 3);
  for (int x = 0; x < 512; ++x) {
    levels(x, 0) = static_cast<std::uint8_t>(x / 2);                  // increases
    levels(x, 1) = static_cast<std::uint8_t>(255 - x / 2);            // decreases
    levels(x, 2) = static_cast<std::uint8_t>(x < 256 ? x : 511 - x);  // increases, then decreases
  }
  expect_reference(levels);
  EXPECT_EQ(256, test::trees_of(levels).count[0]);
}

TEST(MaxTree, HasOneNodeForAFlatRow) {
  const MaxTrees trees = test::trees_of(GrayPlane(40, 2, 7));
  for (int y = 0; y < 2; ++y) {
    EXPECT_EQ((std::vector<Outline>{{0, 39, -1, -1}}), outlines(trees, y));
  }
}

/// The lowest level of a run of pixels.
int node_level(const GrayPlane& levels, int y, int begin, int end) {
  return *std::min_element(&levels(begin, y), &levels(end, y) + 1);
}

TEST(MaxTree, NodesNestAndLevelsIncreaseFromParentToChild) {
  const GrayPlane levels = test::runs(500, 40, 4, 15);
  const MaxTrees trees = test::trees_of(levels);
  for (int y = 0; y < levels.height; ++y) {
    const std::ptrdiff_t row = trees.first[y];
    int roots = 0;
    for (int i = 0; i < trees.count[y]; ++i) {
      const int parent = trees.parent[row + i];
      const int begin = trees.begin[row + i], end = trees.end[row + i];
      if (parent == kNoNode) {
        ++roots;
        EXPECT_EQ(0, begin);
        EXPECT_EQ(levels.width - 1, end);
        continue;
      }
      const int parent_begin = trees.begin[row + parent], parent_end = trees.end[row + parent];
      EXPECT_TRUE(parent_begin <= begin && end <= parent_end) << "row " << y << ", node " << i;
      EXPECT_LT(end - begin, parent_end - parent_begin) << "row " << y << ", node " << i;
      EXPECT_GT(node_level(levels, y, begin, end), node_level(levels, y, parent_begin, parent_end))
          << "row " << y << ", node " << i;
    }
    EXPECT_EQ(1, roots) << "row " << y;
  }
}

TEST(MaxTree, AreasAddUp) {
  // The area of a node is the sum of the areas of its children and of the pixels at its own level.
  const GrayPlane levels = test::runs(333, 30, 5, 9);
  const MaxTrees trees = test::trees_of(levels);
  for (int y = 0; y < levels.height; ++y) {
    const std::ptrdiff_t row = trees.first[y];
    for (int i = 0; i < trees.count[y]; ++i) {
      const int begin = trees.begin[row + i], end = trees.end[row + i];
      const int level = node_level(levels, y, begin, end);
      long area = std::count(&levels(begin, y), &levels(end, y) + 1, level);
      for (int child = 0; child < trees.count[y]; ++child) {
        if (trees.parent[row + child] != i) continue;
        area += trees.end[row + child] - trees.begin[row + child] + 1;
      }
      EXPECT_EQ(end - begin + 1, area) << "row " << y << ", node " << i;
    }
  }
}

TEST(MaxTree, WritesOnlyTheGivenRows) {
  const GrayPlane levels = test::runs(50, 12, 6, 7);
  MaxTrees trees = test::trees_of(levels, 4);
  const GrayPlane other = test::noise(50, 12, 7, 15);  // more nodes
  build_max_trees(image_of(other), 4, 8, trees);
  for (int y = 0; y < 12; ++y) {
    const GrayPlane& source = y >= 4 && y < 8 ? other : levels;
    EXPECT_EQ(outlines(reference::max_tree(&source(0, y), 50)), outlines(trees, y)) << "row " << y;
  }
}

}  // namespace
}  // namespace mtstereo::max_tree_test
