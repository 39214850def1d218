// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/nodes/node_extrapolation.hpp"

#include <gtest/gtest.h>

#include "reference/nodes/node_extrapolation.hpp"
#include "stages/nodes/disparity_drawing.hpp"
#include "support/compare.hpp"
#include "support/stages.hpp"

namespace mtstereo::node_extrapolation_test {
namespace {

constexpr int kWhole = 0;  // width of the ends: the whole leaf
constexpr int kOnePixel = 1;

/// Extrapolates the leaves of a whole map in bands of `band` rows.
DisparityPlane extrapolated(const NodeLevel& leaves, const DisparityPlane& map, int neighbors,
                            int end_width, int band = 1 << 20) {
  Image<std::int32_t> image = image_of(map);
  LeafDisparities ends;
  ends.resize(leaves);
  for (int y = 0; y < map.height; y += band) {
    read_leaf_ends(leaves, image, y, std::min(y + band, map.height), ends);
  }
  for (int y = 0; y < map.height; y += band) {
    extrapolate_leaves(leaves, neighbors, end_width, y, std::min(y + band, map.height), ends,
                       image);
  }
  return copy_of(image);
}

DisparityPlane random_map(int width, int height, std::uint64_t seed) {
  Random random(seed);
  DisparityPlane map(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 1; x < width; ++x) {
      if (random.below(3) == 0) map(x, y) = random.between(1, x * 256);
    }
  }
  return map;
}

TEST(NodeExtrapolation, TakeMatchEndsEqualsReadingADrawnMap) {
  long known = 0;
  for (int width = 1; width <= 70; ++width) {
    const NodeLevel leaves = test::RandomLevels(width, 12, 0, 300 + width).left;
    Random random(width);
    NodeMatches matches;
    matches.resize(leaves);
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      const bool matched = random.below(3) > 0;
      matches.begin_disparity[i] =
          static_cast<std::int16_t>(matched ? random.below(width) : kNodeUnmatched);
      matches.end_disparity[i] =
          static_cast<std::int16_t>(matched ? random.below(width) : kNodeUnmatched);
    }
    Image<std::int32_t> map = image_of(DisparityPlane(width, 12, 77));
    draw_matches(leaves, matches, 0, 12, map);
    LeafDisparities read, taken;
    read.resize(leaves);
    taken.resize(leaves);
    read_leaf_ends(leaves, map, 0, 12, read);
    for (int y = 0; y < 12; y += 5) {
      take_match_ends(leaves, matches, y, std::min(y + 5, 12), taken);
    }
    for (int y = 0; y < 12; ++y) {
      for (std::size_t i = leaves.first[y]; i < leaves.first[y] + leaves.count[y]; ++i) {
        ASSERT_EQ(read.begin[i], taken.begin[i]) << "row " << y << " of " << width << " px";
        ASSERT_EQ(read.end[i], taken.end[i]) << "row " << y << " of " << width << " px";
        known += read.begin[i] != kNoDisparity;
      }
    }
  }
  EXPECT_GT(known, 500) << "too few results to compare";
}

TEST(NodeExtrapolation, EqualsReferenceAtEveryWidthInBothModes) {
  for (int width = 1; width <= 70; ++width) {
    const test::RandomLevels levels(width, 14, 0, 700 + width);
    const DisparityPlane map = random_map(width, 14, width);
    for (const int neighbors : {0, 1, 10}) {
      for (const int end_width : {0, 1, 3, 7}) {
        EXPECT_TRUE(same_image(reference::extrapolate(levels.plain_left, map, neighbors, end_width),
                               extrapolated(levels.left, map, neighbors, end_width, 5)))
            << width << " px, " << neighbors << " neighbors";
      }
    }
  }
}

/// Three rows with one leaf [10, 17] each; the first and the last one have disparities.
struct Column {
  Column() : rows(40, 3), map(40, 3) {
    for (int y = 0; y < 3; ++y) {
      for (int x = 10; x <= 17; ++x) rows(x, y) = 1;
    }
    for (const int y : {0, 2}) {
      map(10, y) = (3 + y) * 256;
      map(17, y) = (7 + y) * 256;
    }
    leaves = test::level_of(test::trees_of(rows), 0, test::kAnyWidth);
  }
  GrayPlane rows;
  DisparityPlane map;
  NodeLevel leaves;
};

TEST(NodeExtrapolation, AssignsTheMediansOfTheNeighborsToALeaf) {
  const Column column;
  const DisparityPlane out = extrapolated(column.leaves, column.map, 1, kWhole);
  for (int x = 10; x <= 17; ++x) {
    EXPECT_NEAR(256 * (3 + 4.0 * (x - 10) / 7), out(x, 1), 1) << "the lower of two medians";
  }
  EXPECT_EQ(0, out(9, 1));
  EXPECT_EQ(0, out(18, 1));
}

TEST(NodeExtrapolation, IgnoresOtherLeavesWithZeroNeighbors) {
  const Column column;
  const DisparityPlane out = extrapolated(column.leaves, column.map, 0, kWhole);
  for (int x = 0; x < 40; ++x) EXPECT_EQ(0, out(x, 1)) << "column " << x;
  EXPECT_EQ(3 * 256, out(10, 0));
}

TEST(NodeExtrapolation, DrawsSparseDisparitiesInsideTheEnds) {
  const Column column;
  const DisparityPlane out = extrapolated(column.leaves, column.map, 1, kOnePixel);
  for (int x = 0; x < 40; ++x) {
    EXPECT_EQ(x == 12 ? 3 * 256 : x == 15 ? 7 * 256 : 0, out(x, 1)) << "column " << x;
  }
}

TEST(NodeExtrapolation, DrawsSparseDisparitiesAtTheEndsOfNarrowLeaves) {
  for (int width = 1; width <= 6; ++width) {
    GrayPlane rows(40, 1);
    DisparityPlane map(40, 1);
    for (int x = 20; x < 20 + width; ++x) rows(x, 0) = 1;
    map(20, 0) = map(19 + width, 0) = 5 * 256;
    const NodeLevel leaves = test::level_of(test::trees_of(rows), 0, test::kAnyWidth);
    const DisparityPlane out = extrapolated(leaves, map, 1, kOnePixel);
    const int inside = width > 4 ? 2 : 0;
    for (int x = 0; x < 40; ++x) {
      const bool end = x == 20 + inside || x == 19 + width - inside;
      EXPECT_EQ(end ? 5 * 256 : 0, out(x, 0)) << "column " << x << ", leaf of " << width << " px";
    }
  }
}

TEST(NodeExtrapolation, NeedsBothEnds) {
  Column column;
  for (const int y : {0, 2}) column.map(17, y) = 0;
  const DisparityPlane out = extrapolated(column.leaves, column.map, 1, kWhole);
  EXPECT_TRUE(same_image(DisparityPlane(40, 3), out));
}

}  // namespace
}  // namespace mtstereo::node_extrapolation_test
