// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/nodes/disparity_drawing.hpp"

#include <gtest/gtest.h>

#include "reference/nodes/disparity_drawing.hpp"
#include "support/compare.hpp"
#include "support/stages.hpp"

namespace mtstereo::disparity_drawing_test {
namespace {

TEST(DrawNode, IsLinearFromEndToEnd) {
  Random random(1);
  for (int n = 0; n < 2000; ++n) {
    const int begin = random.between(1024, 1100);
    const int end = begin + random.below(n % 7 == 0 ? 2 : 300);
    const int at_begin = random.between(1, 1024 * 256), at_end = random.between(1, 1024 * 256);
    std::vector<std::int32_t> row(1500, -1);
    draw_node(begin, end, at_begin, at_end, row.data());
    ASSERT_EQ(at_begin, row[begin]);
    ASSERT_EQ(end > begin ? at_end : at_begin, row[end]);
    for (int x = begin; x <= end; ++x) {
      const double exact = end == begin ? at_begin
                                        : at_begin + (static_cast<double>(at_end) - at_begin) *
                                                         (x - begin) / (end - begin);
      ASSERT_NEAR(exact, row[x], 1) << "column " << x << " of [" << begin << ", " << end << "]";
    }
    ASSERT_EQ(-1, row[begin - 1]);
    ASSERT_EQ(-1, row[end + 1]);
  }
}

TEST(DrawNode, EqualsReferenceForAnyLengthAndSlope) {
  Random random(2);
  for (int n = 0; n < 3000; ++n) {
    const int width = random.between(1, n % 50 == 0 ? 16384 : 400);
    const int begin = random.below(width), end = random.between(begin, width - 1);
    const int most = n % 3 == 0 ? 3 : 1024 * 256;
    const int at_begin = random.below(most), at_end = random.below(most);
    DisparityPlane expected(width, 1);
    reference::draw_node(begin, end, at_begin, at_end, 0, expected);
    DisparityPlane actual(width, 1);
    draw_node(begin, end, at_begin, at_end, actual.pixels.data());
    ASSERT_TRUE(same_image(expected, actual))
        << at_begin << " to " << at_end << " in [" << begin << ", " << end << "]";
  }
}

TEST(DrawNode, SkipsPixelsWithoutARightPixel) {
  std::vector<std::int32_t> row(20, -1);
  draw_node(2, 15, 6 * 256, 6 * 256, row.data());
  for (int x = 0; x < 20; ++x)
    EXPECT_EQ(x >= 6 && x <= 15 ? 6 * 256 : -1, row[x]) << "column " << x;
}

TEST(DrawNode, DrawsDisparityZeroAsTheSmallestKnownValue) {
  std::vector<std::int32_t> row(8, 0);
  draw_node(1, 6, 0, 0, row.data());
  EXPECT_EQ((std::vector<std::int32_t>{0, 1, 1, 1, 1, 1, 1, 0}), row);
}

TEST(DrawNode, SkipsColumnZero) {
  std::vector<std::int32_t> row(3, -1);
  draw_node(0, 2, 0, 0, row.data());
  EXPECT_EQ(-1, row[0]) << "there is no right pixel 1/256 px left of column 0";
}

TEST(DrawMatches, EqualsReferenceAtEveryWidth) {
  for (int width = 1; width <= 70; ++width) {
    const test::RandomLevels levels(width, 12, 0, 500 + width);
    Random random(width);
    NodeMatches matches;
    matches.resize(levels.left);
    reference::Matches plain;
    for (int y = 0; y < 12; ++y) {
      plain.emplace_back(levels.plain_left[y].size());
      for (int i = 0; i < levels.left.count[y]; ++i) {
        if (random.below(3) > 0) plain[y][i] = {random.below(width), random.below(width)};
        matches.begin_disparity[levels.left.first[y] + i] =
            static_cast<std::int16_t>(plain[y][i].begin);
        matches.end_disparity[levels.left.first[y] + i] =
            static_cast<std::int16_t>(plain[y][i].end);
      }
    }
    Image<std::int32_t> map = image_of(DisparityPlane(width, 12, 77));
    for (int y = 0; y < 12; y += 5) draw_matches(levels.left, matches, y, std::min(y + 5, 12), map);
    EXPECT_TRUE(same_image(reference::draw_matches(levels.plain_left, plain, width), map));
  }
}

}  // namespace
}  // namespace mtstereo::disparity_drawing_test
