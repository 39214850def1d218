// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/block_grid.hpp"

#include <gtest/gtest.h>

#include "reference/prepare/block_borders.hpp"
#include "reference/refine/block_grid.hpp"
#include "support/blocks.hpp"
#include "support/plane.hpp"
#include "support/random.hpp"

namespace mtstereo::block_grid_test {
namespace {

/// A view and its map.
struct Matched {
  GrayPlane left;
  reference::ConfidentMap in;
  int side = 8;

  int level(int band = 1 << 20) const {
    BlockGrid grid;
    for (int y = 0; y < left.height; y += band) {
      const int end = std::min(y + band, left.height);
      grid.add(measure_grid(in.map.view(), in.confidence.view(), side, y, end));
    }
    return grid.level(measure_borders(left.view(), side, 0, left.height));
  }
  int expected() const {
    return reference::grid_level(reference::border_visibility(left, side), in, side);
  }
};

/// Disparities of 4 to 60 px, `percent` of them multiples of 8.
Matched matched(const GrayPlane& left, int percent, std::uint64_t seed) {
  test::Random random(seed);
  Matched made{left,
               {DisparityPlane(left.width, left.height), GrayPlane(left.width, left.height, 200)}};
  for (std::int32_t& value : made.in.map.pixels) {
    const bool block = random.below(100) < percent;
    value = block ? random.between(1, 7) * 8 * kDisparityOne
                  : random.between(4 * kDisparityOne, 60 * kDisparityOne);
  }
  return made;
}

TEST(BlockGrid, HasTheLevelOfThePlainSumsAtEveryWidthAndBand) {
  std::array<int, 5> levels{};
  test::Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const int width = random.between(1, 90), height = random.between(1, 60);
    const GrayPlane left =
        test::blocks(width, height, random.between(0, 7), random.between(0, 2), i);
    Matched in = matched(left, random.between(0, 14), i);
    in.side = random.below(3) == 0 ? 4 : 8;
    for (std::uint8_t& value : in.in.confidence.pixels) {
      value = static_cast<std::uint8_t>(random.between(10, 60));
    }
    for (std::int32_t& value : in.in.map.pixels) {
      if (random.below(10) == 0) value = kNoDisparity;
    }
    const int expected = in.expected();
    ++levels[expected];
    for (const int band : {1, 7, 32}) ASSERT_EQ(expected, in.level(band)) << i << ", band " << band;
  }
  for (const int count : levels) EXPECT_GT(count, 0) << "not every level was tried";
}

TEST(BlockGrid, IsMatchedWhereManyDisparitiesAreMultiplesOfBlocks) {
  const GrayPlane left = test::blocks(200, 120, 0, 0, 2);
  EXPECT_EQ(0, matched(left, 0, 3).level());
  int last = 0;
  for (const int percent : {3, 6, 12, 40}) {
    const int level = matched(left, percent, 4).level();
    EXPECT_GE(level, last) << percent;
    last = level;
  }
  EXPECT_EQ(4, last);
}

TEST(BlockGrid, IsNotThatOfViewsWithoutBlocks) {
  test::Random random(5);
  GrayPlane noise(200, 120);
  for (std::uint8_t& pixel : noise.pixels)
    pixel = static_cast<std::uint8_t>(random.between(90, 110));
  EXPECT_EQ(0, matched(noise, 40, 6).level()) << "a wall at 8 px in views without compression";
}

TEST(BlockGrid, IsFoundInHalvedViews) {
  Matched halved = matched(test::blocks(200, 120, 0, 0, 12), 0, 13);
  GrayPlane half(100, 60);
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 100; ++x) half(x, y) = halved.left(2 * x, 2 * y);
  }
  halved = matched(half, 0, 14);
  halved.side = kHalvedBlockSide;
  EXPECT_EQ(0, halved.level());
  for (std::size_t i = 0; i < halved.in.map.pixels.size(); i += 2) {
    halved.in.map.pixels[i] = 12 * kDisparityOne;
  }
  EXPECT_EQ(4, halved.level());
}

TEST(BlockGrid, IgnoresTheFarDistanceAndInferredPixels) {
  const GrayPlane left = test::blocks(200, 120, 0, 0, 9);
  Matched sky = matched(left, 0, 10);
  for (int i = 0; i < 100 * 60; ++i) sky.in.map.pixels[i] = 1;
  EXPECT_EQ(0, sky.level());

  Matched inferred = matched(left, 40, 11);
  ASSERT_EQ(4, inferred.level());
  for (std::uint8_t& value : inferred.in.confidence.pixels) value = kMostInferred;
  EXPECT_EQ(0, inferred.level());
}

TEST(BlockGrid, HasABinForEachLevelAndDistance) {
  std::vector<std::int32_t> map;
  for (int value = 1; value < 40 * kDisparityOne; value += 3) map.push_back(value);
  const int width = static_cast<int>(map.size());
  std::vector<std::uint8_t> bins(map.size());
  for (const int side : {4, 8}) {
    for (int level = 0; level <= 4; ++level) {
      find_grid_bins(level, side, map.data(), width, bins.data());
      for (int i = 0; i < width; ++i) {
        ASSERT_EQ(reference::grid_bin(level, side, map[i] / double{kDisparityOne}), bins[i])
            << map[i] << " at level " << level;
      }
    }
  }
}

}  // namespace
}  // namespace mtstereo::block_grid_test
