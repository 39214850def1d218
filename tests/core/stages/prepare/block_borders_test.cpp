// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/prepare/block_borders.hpp"

#include <gtest/gtest.h>

#include "reference/prepare/block_borders.hpp"
#include "support/blocks.hpp"

namespace mtstereo::block_borders_test {
namespace {

BlockBorders measured(const GrayPlane& view, int side = kBlockSide, int band = 1 << 20) {
  BlockBorders borders = {side};
  for (int y = 0; y < view.height; y += band) {
    borders.add(measure_borders(view.view(), side, y, std::min(y + band, view.height)));
  }
  return borders;
}

TEST(BlockBorders, AreAsVisibleAsByThePlainSumsAtEveryWidthAndBand) {
  int visible = 0;
  test::Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const int width = random.between(1, 90), height = random.between(1, 60);
    const GrayPlane view =
        test::blocks(width, height, random.between(0, 7), random.between(0, 4), i);
    const int side = random.below(3) == 0 ? kHalvedBlockSide : kBlockSide;
    const double expected = reference::border_visibility(view, side);
    for (const int band : {1, 7, 32}) {
      ASSERT_DOUBLE_EQ(expected, measured(view, side, band).visibility()) << i << ", " << band;
    }
    visible += measured(view, side).visible();
  }
  EXPECT_GT(visible, 100);
  EXPECT_LT(visible, 900);
}

TEST(BlockBorders, AreThoseOfCroppedViewsToo) {
  for (int phase = 0; phase < 8; ++phase) {
    EXPECT_GT(measured(test::blocks(200, 120, phase, 1, 7)).visibility(), 2) << phase;
  }
}

TEST(BlockBorders, AreNotVisibleInNoise) {
  test::Random random(5);
  for (const auto& [width, height] : {std::pair(200, 120), std::pair(640, 480), std::pair(20, 9)}) {
    GrayPlane noise(width, height);
    for (std::uint8_t& pixel : noise.pixels) {
      pixel = static_cast<std::uint8_t>(random.between(90, 110));
    }
    EXPECT_LT(measured(noise).visibility(), 1.03) << width;
  }
}

TEST(BlockBorders, AreNotVisibleInViewsWithoutDetailOrColumns) {
  EXPECT_FALSE(measured(GrayPlane(64, 48, 100)).visible());
  EXPECT_EQ(0, measured(GrayPlane(10, 48, 100)).visibility());
}

}  // namespace
}  // namespace mtstereo::block_borders_test
