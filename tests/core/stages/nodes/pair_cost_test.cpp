// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/nodes/pair_cost.hpp"

#include <gtest/gtest.h>

#include "reference/nodes/pair_cost.hpp"
#include "support/stages.hpp"

namespace mtstereo::pair_cost_test {
namespace {

using test::RandomLevels;
using test::RandomVolume;

/// A random pair of nodes with possible disparities.
NodePair random_pair(int width, int disparities, Random& random) {
  NodePair pair{};
  do {
    pair.left_begin = random.below(width);
    pair.left_end = random.between(pair.left_begin, std::min(width - 1, pair.left_begin + 40));
    pair.right_begin = pair.left_begin - random.below(disparities);
    pair.right_end = pair.left_end - random.below(disparities);
  } while (pair.right_begin < 0 || pair.right_end < pair.right_begin);
  return pair;
}

TEST(IntensityCost, EqualsReference) {
  Random random(1);
  for (const int shift : {0, 1}) {
    for (const int disparities : {1, 2, 19, 60}) {
      const RandomVolume volume = test::random_volume(80, 3, disparities, shift, random);
      for (int n = 0; n < 500; ++n) {
        const NodePair pair = random_pair(80, disparities, random);
        const int y = random.below(3);
        ASSERT_EQ(
            reference::intensity_cost<float>(volume.plain, y, {pair.left_begin, pair.left_end, 0},
                                             {pair.right_begin, pair.right_end, 0}),
            intensity_cost(volume.fast, y, pair))
            << "[" << pair.left_begin << ", " << pair.left_end << "] and [" << pair.right_begin
            << ", " << pair.right_end << "], shift " << shift;
      }
    }
  }
}

/// Bounds of the mean cost along the exact line: where it passes between two disparities closer
/// than 16 fractional bits resolve, either of them is accepted.
std::pair<double, double> bounds_on_the_line(const reference::Volume& volume, int y,
                                             const NodePair& pair) {
  const double length = std::max(pair.left_end - pair.left_begin, 1);
  double low = 0, high = 0;
  int count = 0;
  for (int x = pair.left_begin; x <= pair.left_end; x += 1 << volume.shift, ++count) {
    const double d = pair.begin_disparity() + (pair.end_disparity() - pair.begin_disparity()) *
                                                  (x - pair.left_begin) / length;
    const double slack = (x - pair.left_begin + 1) / 65536.0;
    const int a = volume.at(x, y, static_cast<int>(std::floor(d - slack + 0.5)));
    const int b = volume.at(x, y, static_cast<int>(std::floor(d + slack + 0.5)));
    low += std::min(a, b);
    high += std::max(a, b);
  }
  return {low / (16 * count), high / (16 * count)};
}

TEST(IntensityCost, FollowsTheLineBetweenTheEnds) {
  Random random(2);
  for (const int shift : {0, 1}) {
    const RandomVolume volume = test::random_volume(3000, 1, 700, shift, random);
    for (int n = 0; n < 300; ++n) {
      const int begin = random.between(700, 1500);
      const int end = begin + random.below(1400);
      const NodePair pair{begin, end, begin - random.below(700), end - random.below(700)};
      const auto [low, high] = bounds_on_the_line(volume.plain, 0, pair);
      const float cost = intensity_cost(volume.fast, 0, pair);
      EXPECT_GE(cost, low * (1 - 1e-6)) << "begin " << begin << ", end " << end;
      EXPECT_LE(cost, high * (1 + 1e-6)) << "begin " << begin << ", end " << end;
    }
  }
}

TEST(IntensityCost, EqualsThePixelCostForOnePixel) {
  Random random(3);
  const RandomVolume volume = test::random_volume(50, 1, 20, 0, random);
  const NodePair pair{30, 30, 17, 17};
  EXPECT_FLOAT_EQ(static_cast<float>(volume.plain.at(30, 0, 13)) / 16,
                  intensity_cost(volume.fast, 0, pair));
}

TEST(IntensityCost, StaysInTheVolumeForTheLongestAndSteepestNodes) {
  Random random(4);
  for (const int shift : {0, 1}) {
    const RandomVolume volume = test::random_volume(8192, 1, 16, shift, random);
    for (const auto& [begin, end] : {std::pair{0, 15}, {15, 0}, {15, 15}, {0, 0}, {1, 0}, {0, 1}}) {
      const NodePair pair{15, 8191, 15 - begin, 8191 - end};
      const auto [low, high] = bounds_on_the_line(volume.plain, 0, pair);
      EXPECT_GE(intensity_cost(volume.fast, 0, pair), low * (1 - 1e-6));
      EXPECT_LE(intensity_cost(volume.fast, 0, pair), high * (1 + 1e-6));
    }
    const NodePair shortest{100, 101, 85, 101};
    EXPECT_EQ(reference::intensity_cost<float>(volume.plain, 0, {100, 101, 0}, {85, 101, 0}),
              intensity_cost(volume.fast, 0, shortest));
  }
}

/// Compares the context cost of all pairs of nodes of all rows.
void expect_context(const RandomLevels& levels) {
  for (int y = 0; y < levels.left.height; ++y) {
    for (int i = 0; i < levels.left.count[y]; ++i) {
      for (int j = 0; j < levels.right.count[y]; ++j) {
        const int left = levels.left.node[levels.left.first[y] + i];
        const int right = levels.right.node[levels.right.first[y] + j];
        const double expected = reference::context_cost<double>(
            levels.plain_left_trees[y], levels.plain_right_trees[y],
            levels.plain_left[y][i].tree_node, levels.plain_right[y][j].tree_node);
        ASSERT_NEAR(expected, context_cost(levels.left_trees, levels.right_trees, y, left, right),
                    1e-4)
            << "row " << y << ", nodes " << i << " and " << j;
      }
    }
  }
}

TEST(ContextCost, EqualsReference) {
  for (int ancestor = 0; ancestor < 3; ++ancestor) {
    expect_context(RandomLevels(120, 8, ancestor, 10 + ancestor));
  }
}

TEST(ContextCost, IsZeroForEqualTrees) {
  const test::GrayPlane rows = test::runs(100, 5, 20, 7);
  const RandomLevels levels(rows, rows, 0);
  for (int y = 0; y < 5; ++y) {
    for (int i = 0; i < levels.left.count[y]; ++i) {
      const int node = levels.left.node[levels.left.first[y] + i];
      EXPECT_EQ(0, context_cost(levels.left_trees, levels.right_trees, y, node, node));
    }
  }
}

TEST(ContextCost, IsTheMeanRelativeDifferenceOfAreas) {
  test::GrayPlane left(20, 1), right(20, 1);
  for (int x = 4; x < 10; ++x) left(x, 0) = 1;  // 6 px below the root of 20 px
  for (int x = 4; x < 6; ++x) right(x, 0) = 1;  // 2 px below the root of 20 px
  const RandomLevels levels(left, right, 0);
  const float expected = 225 * (std::abs(6.0f / 8 - 0.5f) + 0) / 2;
  EXPECT_NEAR(expected,
              context_cost(levels.left_trees, levels.right_trees, 0, levels.left.node[0],
                           levels.right.node[0]),
              1e-4);
}

/// Compares the cost of every pair of every row with the reference, in the order of matching.
void expect_pair_costs(const RandomLevels& levels, int disparities, int neighbors, int shift,
                       float alpha) {
  SCOPED_TRACE(testing::Message() << levels.left.width << " px, " << disparities << " disparities, "
                                  << neighbors << " neighbors");
  Random random(30);
  const RandomVolume volume =
      test::random_volume(levels.left.width, levels.left.height, disparities, shift, random);
  const PairCostInput input = levels.input(volume, alpha);
  const reference::PairInput plain = levels.plain_input(volume, alpha);
  PairCosts costs;
  costs.resize(levels.left.width, disparities, neighbors);
  costs.start(input);
  for (int y = 0; y < levels.left.height; ++y) {
    costs.move_to(y);
    const int above = std::max(y - neighbors, 0);
    const int below = std::min(y + neighbors, levels.left.height - 1);
    for (const int row : {y, above, below}) {
      for (int i = 0; i < levels.left.count[row]; ++i) {
        const PairCosts::Candidates range = costs.candidates(row, i);
        for (int j = 0; j < levels.right.count[row]; ++j) {
          const bool possible =
              reference::ends(levels.plain_left[row][i], levels.plain_right[row][j])
                  .possible(disparities);
          ASSERT_EQ(possible, range.first <= j && j < range.last) << "row " << row;
          if (!possible) {
            ASSERT_LT(costs(row, i, j), 0) << "row " << row << ", nodes " << i << " and " << j;
            continue;
          }
          ASSERT_EQ(reference::pair_cost<float>(plain, row, i, j), costs(row, i, j))
              << "row " << row << ", nodes " << i << " and " << j;
          ASSERT_NEAR(reference::pair_cost<double>(plain, row, i, j), costs(row, i, j), 0.01);
        }
      }
    }
  }
}

TEST(PairCosts, EqualReferenceForEveryPair) {
  for (int width = 1; width <= 70; width += 3) {
    for (const int disparities : {1, 2, 5, width}) {
      if (disparities > width) continue;
      expect_pair_costs(RandomLevels(width, 9, width % 2, width), disparities, width % 4, width % 2,
                        0.8f);
    }
  }
}

TEST(PairCosts, EqualReferenceForEveryWeight) {
  for (const float alpha : {0.0f, 0.3f, 1.0f}) {
    expect_pair_costs(RandomLevels(60, 7, 0, 40), 20, 2, 1, alpha);
  }
}

TEST(PairCosts, EqualReferenceForTheDensestRows) {
  // A leaf in every second column, the largest possible number.
  test::GrayPlane rows(201, 5);
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 201; x += 2) rows(x, y) = 1;
  }
  for (const int disparities : {1, 2, 3, 64, 201}) {
    expect_pair_costs(RandomLevels(rows, rows, 0), disparities, 1, 1, 0.8f);
  }
}

}  // namespace
}  // namespace mtstereo::pair_cost_test
