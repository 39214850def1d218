// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/gap_filling.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "reference/refine/gap_filling.hpp"
#include "support/compare.hpp"
#include "support/random_maps.hpp"

namespace mtstereo::gap_filling_test {
namespace {

using reference::ConfidentMap;
using test::disparity_noise;
using test::patches;

constexpr int kMost = std::numeric_limits<std::int32_t>::max();
constexpr int kWhole = 1 << 20;

/// A map with a random confidence at each of its known pixels.
ConfidentMap confident(const DisparityPlane& map, std::uint64_t seed = 1) {
  test::Random random(seed);
  ConfidentMap made{map, GrayPlane(map.width, map.height)};
  for (std::size_t i = 0; i < map.pixels.size(); ++i) {
    if (map.pixels[i] == 0) continue;
    made.confidence.pixels[i] = static_cast<std::uint8_t>(
        random.below(3) == 0 ? random.between(1, 3) : random.between(1, 255));
  }
  return made;
}

/// Fills gaps along rows, in bands of `band` rows.
ConfidentMap filled_along_rows(const ConfidentMap& in, int max_gap, int tolerance,
                               int band = kWhole) {
  Image<std::int32_t> map = image_of(in.map);
  Image<std::uint8_t> confidence = image_of(in.confidence);
  for (int y = 0; y < map.height(); y += band) {
    fill_gaps_along_rows({max_gap, tolerance}, y, std::min(y + band, map.height()), map,
                         confidence);
  }
  return {copy_of(map), copy_of(confidence)};
}

/// Fills gaps along columns, in blocks of `block` columns.
ConfidentMap filled_along_columns(const ConfidentMap& in, int max_gap, int tolerance,
                                  int block = kWhole) {
  Image<std::int32_t> map = image_of(in.map);
  Image<std::uint8_t> confidence = image_of(in.confidence);
  for (int x = 0; x < map.width(); x += block) {
    fill_gaps_along_columns({max_gap, tolerance}, x, std::min(x + block, map.width()), map,
                            confidence);
  }
  return {copy_of(map), copy_of(confidence)};
}

testing::AssertionResult same(const ConfidentMap& expected, const ConfidentMap& actual) {
  const testing::AssertionResult map = same_image(expected.map, actual.map);
  return map ? same_image(expected.confidence, actual.confidence) : map;
}

void expect_reference(const ConfidentMap& in, int max_gap, int tolerance) {
  SCOPED_TRACE(testing::Message() << "gaps of " << max_gap << ", tolerance " << tolerance);
  const ConfidentMap rows = reference::fill_gaps(in, max_gap, tolerance, 1, 0);
  const ConfidentMap columns = reference::fill_gaps(in, max_gap, tolerance, 0, 1);
  for (const int share : {1, 7, 64, kWhole}) {
    EXPECT_TRUE(same(rows, filled_along_rows(in, max_gap, tolerance, share))) << share;
    EXPECT_TRUE(same(columns, filled_along_columns(in, max_gap, tolerance, share))) << share;
  }
}

TEST(GapFilling, EqualsReferenceAtEveryWidth) {
  for (int width = 1; width <= 70; ++width) {
    for (int of_ten = 0; of_ten < 10; ++of_ten) {
      const DisparityPlane map = patches(width, 1 + width % 37, of_ten, 10 * width + of_ten);
      expect_reference(confident(map), 1 + width % 20, 512);
    }
  }
}

TEST(GapFilling, EqualsReferenceInOneRowAndInOneColumn) {
  for (int length = 1; length <= 100; ++length) {
    expect_reference(confident(disparity_noise(length, 1, 7, 5000, length)), 9, 2000);
    expect_reference(confident(disparity_noise(1, length, 7, 5000, length)), 9, 2000);
  }
}

TEST(GapFilling, EqualsReferenceForEveryLengthOfGap) {
  const ConfidentMap in = confident(disparity_noise(90, 80, 9, 3000, 100));
  for (int max_gap = 0; max_gap <= 90; ++max_gap) expect_reference(in, max_gap, 3000);
}

TEST(GapFilling, EqualsReferenceForEveryTolerance) {
  const ConfidentMap in = confident(disparity_noise(60, 61, 6, 900, 200));
  for (int tolerance = 0; tolerance <= 900; tolerance += 20) expect_reference(in, 8, tolerance);
}

TEST(GapFilling, EqualsReferenceAtExtremes) {
  test::Random random(300);
  DisparityPlane map(64, 50);
  for (std::int32_t& d : map.pixels) {
    constexpr std::int32_t kExtremes[] = {1, 2, test::kLargestDisparity, kMost - 1, kMost};
    if (random.below(3) == 0) d = kExtremes[random.below(5)];
  }
  for (const int max_gap : {-kMost - 1, -1, 0, 1, 64, kMost}) {
    for (const int tolerance : {-1, 0, 1, test::kLargestDisparity, kMost}) {
      expect_reference(confident(map), max_gap, tolerance);
    }
  }
}

TEST(GapFilling, LimitsTheConfidence) {
  const ConfidentMap in = confident(disparity_noise(50, 40, 6, 900, 201));
  for (const int most : {1, 15, 254}) {
    const ConfidentMap expected = reference::fill_gaps(in, 8, 500, 1, 0, most);
    Image<std::int32_t> map = image_of(in.map);
    Image<std::uint8_t> confidence = image_of(in.confidence);
    fill_gaps_along_rows({8, 500, static_cast<std::uint8_t>(most)}, 0, 40, map, confidence);
    EXPECT_TRUE(same(expected, {copy_of(map), copy_of(confidence)})) << most;
  }
}

TEST(GapFilling, RoundsLikeTheReferenceForEverySlopeAndLength) {
  for (int length = 1; length <= 40; ++length) {
    // Each row has a gap of this length with another difference between its ends, positive or
    // negative.
    DisparityPlane map(length + 2, 161);
    for (int y = 0; y <= 160; ++y) {
      map(0, y) = 100;
      map(length + 1, y) = 20 + y;
    }
    const ConfidentMap in = confident(map);
    const ConfidentMap out = filled_along_rows(in, length, 80);
    EXPECT_TRUE(same(reference::fill_gaps(in, length, 80, 1, 0), out));
    EXPECT_EQ(0, std::count(out.map.pixels.begin(), out.map.pixels.end(), 0));
  }
}

TEST(GapFilling, FillsTheLongestRowAndColumn) {
  constexpr int kSide = 16384;
  constexpr long kSteps = kSide - 1;
  DisparityPlane row(kSide, 1);
  DisparityPlane column(1, kSide);
  row(0, 0) = column(0, kSide - 1) = 1;
  row(kSide - 1, 0) = column(0, 0) = test::kLargestDisparity;
  const ConfidentMap rows = filled_along_rows(confident(row), kSide - 2, test::kLargestDisparity);
  const ConfidentMap columns =
      filled_along_columns(confident(column), kSide - 2, test::kLargestDisparity);
  for (long x = 0; x < kSide; ++x) {
    const long doubled = 2 * (kSteps - x + test::kLargestDisparity * x);
    const long rounded = (doubled + kSteps) / (2 * kSteps);
    EXPECT_EQ(rounded, rows.map.pixels[x]) << "column " << x;
    EXPECT_EQ(rounded, columns.map.pixels[kSteps - x]) << "row " << kSteps - x;
  }
}

// Feature: speckle filter, median, filling of gaps
TEST(GapFilling, IsLinearBetweenTheEnds) {
  ConfidentMap gap{DisparityPlane(5, 1), GrayPlane(5, 1)};
  gap.map(0, 0) = 100;
  gap.map(4, 0) = 102;
  gap.confidence(0, 0) = 200;
  gap.confidence(4, 0) = 91;
  const ConfidentMap out = filled_along_rows(gap, 3, 2);
  EXPECT_EQ((std::vector<std::int32_t>{100, 101, 101, 102, 102}), out.map.pixels);
  EXPECT_EQ((std::vector<std::uint8_t>{200, 45, 45, 45, 91}), out.confidence.pixels);
}

TEST(GapFilling, KeepsLongerAndSteeperGaps) {
  DisparityPlane map(6, 6);
  map(0, 2) = map(2, 0) = 1000;
  map(5, 2) = map(2, 5) = 1064;
  const ConfidentMap in = confident(map);
  EXPECT_TRUE(same(in, filled_along_rows(in, 3, 64)));
  EXPECT_TRUE(same(in, filled_along_rows(in, 4, 63)));
  EXPECT_TRUE(same(in, filled_along_columns(in, 3, 64)));
  EXPECT_TRUE(same(in, filled_along_columns(in, 4, 63)));
  EXPECT_NE(in, filled_along_rows(in, 4, 64));
  EXPECT_NE(in, filled_along_columns(in, 4, 64));
}

TEST(GapFilling, KeepsGapsAtTheBorder) {
  DisparityPlane map(9, 9);
  for (int i = 2; i < 7; ++i) map(i, i) = 1000;
  const ConfidentMap in = confident(map);
  EXPECT_TRUE(same(in, filled_along_rows(in, kMost, kMost)));
  EXPECT_TRUE(same(in, filled_along_columns(in, kMost, kMost)));
}

TEST(GapFilling, KeepsCompletelyUnknownAndCompletelyKnownMaps) {
  for (const int disparity : {0, 700}) {
    const ConfidentMap in = confident(DisparityPlane(35, 41, disparity));
    EXPECT_TRUE(same(in, filled_along_rows(in, kMost, kMost)));
    EXPECT_TRUE(same(in, filled_along_columns(in, kMost, kMost)));
  }
}

TEST(GapFilling, WritesAtLeastTheSmallestDisparityAndConfidence) {
  DisparityPlane map(5, 5);
  map(0, 2) = map(4, 2) = map(2, 0) = map(2, 4) = 1;
  ConfidentMap in{map, GrayPlane(5, 5)};
  std::copy(map.pixels.begin(), map.pixels.end(), in.confidence.pixels.begin());
  for (const ConfidentMap& out : {filled_along_rows(in, 3, 0), filled_along_columns(in, 3, 0)}) {
    EXPECT_EQ(1, out.map(2, 2));
    EXPECT_EQ(1, out.confidence(2, 2));
  }
}

TEST(GapFilling, OnlyAddsDisparitiesAndNothingTheSecondTime) {
  for (int seed = 0; seed < 40; ++seed) {
    const ConfidentMap in = confident(patches(60, 50, seed % 8, 400 + seed), seed);
    for (const ConfidentMap& once :
         {filled_along_rows(in, 6, 300), filled_along_columns(in, 6, 300)}) {
      EXPECT_TRUE(only_removes(once.map, in.map)) << "known disparities must not change";
      for (std::size_t i = 0; i < once.map.pixels.size(); ++i) {
        if (in.map.pixels[i] != 0) {
          EXPECT_EQ(in.confidence.pixels[i], once.confidence.pixels[i]);
        }
        EXPECT_EQ(once.map.pixels[i] != 0, once.confidence.pixels[i] != 0);
      }
    }
    const ConfidentMap rows = filled_along_rows(in, 6, 300);
    EXPECT_TRUE(same(rows, filled_along_rows(rows, 6, 300)));
    const ConfidentMap columns = filled_along_columns(in, 6, 300);
    EXPECT_TRUE(same(columns, filled_along_columns(columns, 6, 300)));
  }
}

TEST(GapFilling, StaysInsideTheRightViewIfTheEndsDo) {
  // No disparity exceeds its column: the right pixel would lie left of the view.
  test::Random random(500);
  DisparityPlane map(80, 60);
  for (int y = 0; y < 60; ++y) {
    for (int x = 1; x < 80; ++x) {
      if (random.below(8) == 0)
        map(x, y) = 256 * x - (random.below(2) == 0 ? 0 : random.below(256));
    }
  }
  const ConfidentMap in = confident(map);
  const ConfidentMap out = filled_along_columns(filled_along_rows(in, 40, kMost), 40, kMost);
  long added = 0;
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 80; ++x) {
      EXPECT_LE(out.map(x, y), 256 * x);
      added += out.map(x, y) != 0 && map(x, y) == 0;
    }
  }
  EXPECT_GT(added, 2000) << "too few results to compare";
}

TEST(GapFilling, DoesNotDependOnTheDirection) {
  const ConfidentMap in = confident(disparity_noise(70, 71, 7, 4000, 600));
  const auto turned = [](const ConfidentMap& map) {
    ConfidentMap copy = map;
    std::reverse(copy.map.pixels.begin(), copy.map.pixels.end());
    std::reverse(copy.confidence.pixels.begin(), copy.confidence.pixels.end());
    return copy;
  };
  EXPECT_TRUE(
      same(filled_along_rows(in, 12, 2000), turned(filled_along_rows(turned(in), 12, 2000))));
  EXPECT_TRUE(
      same(filled_along_columns(in, 12, 2000), turned(filled_along_columns(turned(in), 12, 2000))));
}

}  // namespace
}  // namespace mtstereo::gap_filling_test
