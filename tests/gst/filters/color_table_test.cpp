// SPDX-License-Identifier: LGPL-2.1-or-later
#include "filters/color_table.hpp"

#include <gtest/gtest.h>

#include <tuple>

namespace mtstereo::plugin::color_table_test {
namespace {

std::tuple<int, int, int> parts(const Rgb& color) { return {color.red, color.green, color.blue}; }

TEST(ColorTable, OnlyNoDisparityIsBlack) {
  const auto table = color_table(64, 256);
  ASSERT_EQ(table.size(), 65536u);
  EXPECT_EQ(parts(table[0]), std::tuple(0, 0, 0));
  for (std::size_t value = 1; value < table.size(); ++value) {
    ASSERT_NE(parts(table[value]), std::tuple(0, 0, 0)) << value;
  }
}

TEST(ColorTable, UsesTheWholeColorMap) {
  const auto table = color_table(64, 256);
  EXPECT_EQ(parts(table[1]), std::tuple(48, 18, 59));
  EXPECT_EQ(parts(table[64 * 256]), std::tuple(122, 4, 3)) << "last color of the color map";
}

TEST(ColorTable, FarIsBlueAndNearIsRed) {
  const auto table = color_table(64, 256);
  const Rgb far = table[6 * 256];
  const Rgb near = table[58 * 256];
  EXPECT_GT(far.blue, far.red);
  EXPECT_GT(near.red, near.blue);
}

TEST(ColorTable, ValuesAboveTheRangeHaveTheLastColor) {
  const auto table = color_table(16, 256);
  for (std::size_t value = 16 * 256; value < table.size(); ++value) {
    ASSERT_EQ(parts(table[value]), parts(table[65535])) << value;
  }
}

TEST(ColorTable, ColorDependsOnDisparityNotOnScale) {
  const auto fine = color_table(64, 256);
  const auto coarse = color_table(64, 16);
  for (int px = 1; px <= 64; ++px) {
    EXPECT_EQ(parts(fine[static_cast<std::size_t>(px) * 256]),
              parts(coarse[static_cast<std::size_t>(px) * 16]))
        << px << " px";
  }
}

TEST(ColorTable, SupportsTheSmallestAndTheLargestRange) {
  EXPECT_EQ(parts(color_table(1, 1)[1]), parts(color_table(1, 1)[65535]));
  EXPECT_EQ(parts(color_table(1024, 65535)[65535]), parts(color_table(1024, 65535)[60000]))
      << "both values have the color of small disparities";
}

}  // namespace
}  // namespace mtstereo::plugin::color_table_test
