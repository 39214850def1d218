// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixels/gray_balance.hpp"

#include <gtest/gtest.h>

#include "reference/pixels/gray_balance.hpp"
#include "reference/pixels/gray_mapping.hpp"
#include "support/census.hpp"
#include "support/compare.hpp"
#include "support/half_maps.hpp"

namespace mtstereo::gray_balance_test {
namespace {

using test::Pair;

/// The balance of a pair and its map, found in bands of a row of tiles, the last one first.
GrayBalance balance_of(const Pair& pair, const DisparityPlane& map,
                       const GrayMapping& mapping = {}) {
  GrayBalance balance;
  balance.mapping = mapping;
  balance.resize(map.width, map.height);
  test::poison(balance.own);
  test::poison(balance.around);
  const Image<std::int32_t> image = test::image_of(map);
  for (int row = balance.own.height() - 1; row >= 0; --row) {
    measure_differences(pair.left.view(), pair.right.view(), image, row, row + 1, balance);
  }
  const std::int16_t common = common_difference(balance);
  for (int row = balance.own.height() - 1; row >= 0; --row) {
    balance_tiles(common, row, row + 1, balance);
  }
  return balance;
}

GrayPlane balanced(const GrayPlane& left, const GrayBalance& balance) {
  GrayPlane out(left.width, left.height, 0x5A);
  for (int y = 0; y < left.height; ++y)
    balance_row(left.view(), y, balance, 2 * kBalanceTile, &out(0, y));
  return out;
}

Pair noise_pair(int width, int height, std::uint64_t seed) {
  return {test::noise(width, height, seed), test::noise(width, height, seed + 1)};
}

TEST(GrayBalance, EqualsReferenceAtEverySize) {
  Random random(1);
  for (int i = 0; i < 300; ++i) {
    const int width = random.between(1, 150), height = random.between(1, 150);
    const DisparityPlane map =
        test::random_half_map(width, height, 60, random.below(3) == 0 ? 5 : 90, random);
    const Pair half = noise_pair(map.width, map.height, i);
    const GrayBalance balance = balance_of(half, map);
    const auto expected = reference::balance_of(half.left, half.right, map);
    ASSERT_TRUE(same_image(expected, balance.around)) << width << "x" << height;
    const GrayPlane view = test::noise(width, height, 7 * i);
    ASSERT_TRUE(same_image(reference::balanced(view, expected, 32), balanced(view, balance)));
  }
}

TEST(GrayBalance, FindsWhatWasAddedToOneView) {
  const GrayPlane right = test::noise(120, 90, 1, 100);
  const DisparityPlane map(120, 90, 1);  // nearly 0
  for (const int by : {0, 5, 120}) {
    const GrayPlane left = test::brighter(right, by);
    const GrayBalance balance = balance_of({left, right}, map);
    EXPECT_EQ(test::Plane<std::int16_t>(8, 6, static_cast<std::int16_t>(by)),
              copy_of(balance.around));
    EXPECT_EQ(balanced(left, balance), right);
  }
}

TEST(GrayBalance, DiffersBetweenTheSidesOfAView) {
  const GrayPlane right = test::noise(240, 60, 1, 100);
  GrayPlane left = right;
  for (int y = 0; y < 60; ++y) {
    for (int x = 120; x < 240; ++x) left(x, y) = static_cast<std::uint8_t>(left(x, y) + 30);
  }
  const GrayBalance balance = balance_of({left, right}, DisparityPlane(240, 60, 1));
  EXPECT_EQ(0, balance.around.row(0)[0]);
  EXPECT_EQ(30, balance.around.row(3)[14]);
}

TEST(GrayBalance, IgnoresFewWrongMatches) {
  const GrayPlane right = test::noise(160, 160, 1, 100);
  const GrayPlane left = test::brighter(right, 9);
  DisparityPlane map(160, 160, 1);
  Random random(3);
  for (int& disparity : map.pixels) {
    if (random.below(4) == 0) disparity = 256 * random.between(1, 40);
  }
  const GrayBalance balance = balance_of({left, right}, map);
  for (const std::int16_t difference : copy_of(balance.around).pixels) {
    EXPECT_NEAR(difference, 9, 1);
  }
}

TEST(GrayBalance, IsThatOfTheMappedRightView) {
  const GrayPlane left = test::noise(90, 60, 1), right = test::noise(90, 60, 2);
  const DisparityPlane map(90, 60, 256 * 3);
  GrayMapping inverted = {false, {}};
  reference::Grays grays;
  for (int gray = 0; gray < 256; ++gray) {
    grays[gray] = 255 - gray;
    inverted.left_of_right[gray] = static_cast<std::uint8_t>(255 - gray);
  }
  const auto expected = reference::balance_of(left, reference::mapped(right, grays), map);
  EXPECT_TRUE(same_image(expected, balance_of({left, right}, map, inverted).around));
}

TEST(GrayBalance, ChangesNothingWithoutMatches) {
  const GrayPlane view = test::noise(70, 50, 1);
  const GrayBalance balance = balance_of(noise_pair(35, 25, 2), DisparityPlane(35, 25));
  EXPECT_EQ(balanced(view, balance), view);
}

}  // namespace
}  // namespace mtstereo::gray_balance_test
