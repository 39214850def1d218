// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/holding.hpp"

#include <gtest/gtest.h>

#include "mtstereo/parameters.hpp"
#include "reference/refine/holding.hpp"
#include "support/compare.hpp"
#include "support/random.hpp"

namespace mtstereo {
namespace {

using test::copy_of;
using test::DisparityPlane;
using test::GrayPlane;
using test::Random;
using test::same_image;

constexpr LeastConfidence kLeast = {140, 110, 150};

/// Calls body(y0, y1) for the bands of an image of this height.
template <typename Body>
void in_bands(int rows, int height, Body body) {
  for (int y = 0; y < height; y += rows) body(y, std::min(y + rows, height));
}

GrayPlane still_in(const GrayPlane& view, const GrayPlane& last, float noise, int rows = 1 << 20) {
  const Image<std::uint8_t> before = image_of(last);
  Image<std::uint8_t> still;
  still.resize(still_blocks(view.width), still_blocks(view.height));
  int count = 0;
  in_bands(rows, view.height,
           [&](int y0, int y1) { count += find_still(view.view(), before, noise, y0, y1, still); });
  const GrayPlane found = copy_of(still);
  EXPECT_EQ(std::count(found.pixels.begin(), found.pixels.end(), 1), count);
  return found;
}

GrayPlane chosen(const DisparityPlane& map, const DisparityPlane& last, const GrayPlane& still,
                 int rows = 1 << 20) {
  Image<std::uint16_t> before;
  before.resize(map.width, map.height);
  Image<std::uint8_t> least;
  least.resize(map.width, map.height);
  in_bands(rows, map.height, [&](int y0, int y1) { copy_last(image_of(last), y0, y1, before); });
  in_bands(rows, map.height, [&](int y0, int y1) {
    choose_least(kLeast, image_of(still), before, image_of(map), y0, y1, least);
  });
  return copy_of(least);
}

/// The least confidence of one pixel of a still view, with these disparities [1/256 px].
int least_of(int now, int last) {
  return chosen(DisparityPlane(1, 1, now), DisparityPlane(1, 1, last), GrayPlane(1, 1, 1))(0, 0);
}

TEST(Holding, FindsTheStillBlocksOfTheReference) {
  Random random(1);
  for (int width = 1; width <= 40; ++width) {
    const int height = random.between(1, 40);
    const GrayPlane last = test::noise(width, height, width);
    GrayPlane view = last;
    const int most = random.between(1, 9);
    for (std::uint8_t& pixel : view.pixels) {
      pixel = static_cast<std::uint8_t>(pixel ^ random.below(most + 1));
    }
    for (const float noise : {0.0F, 1.0F, 2.3F}) {
      const GrayPlane expected = reference::still_blocks(view, last, noise);
      for (const int rows : {8, 32, 1 << 20}) {
        EXPECT_TRUE(same_image(expected, still_in(view, last, noise, rows))) << width;
      }
    }
  }
}

TEST(Holding, ABlockIsStillUpToItsNoise) {
  const GrayPlane last(8, 8, 100);
  EXPECT_EQ(1, still_in(GrayPlane(8, 8, 101), last, 0)(0, 0));
  EXPECT_EQ(0, still_in(GrayPlane(8, 8, 102), last, 0)(0, 0));
  EXPECT_EQ(1, still_in(GrayPlane(8, 8, 103), last, 1.5F)(0, 0));
  EXPECT_EQ(0, still_in(GrayPlane(8, 8, 97), last, 1.4F)(0, 0));
}

TEST(Holding, ChoosesTheLeastConfidenceOfTheReferenceAtEveryWidth) {
  Random random(2);
  for (int width = 1; width <= 70; ++width) {
    const int height = 19;
    DisparityPlane map(width, height), last(width, height);
    for (std::size_t i = 0; i < map.pixels.size(); ++i) {
      const int most = random.below(3) == 0 ? 12 : kLargestMaxDisparity * kDisparityOne;
      map.pixels[i] = random.below(most + 1);
      if (random.below(4) == 0) continue;
      last.pixels[i] = std::clamp(map.pixels[i] + random.between(-290, 290), 1,
                                  kLargestMaxDisparity * kDisparityOne);
    }
    GrayPlane still(still_blocks(width), still_blocks(height));
    for (std::uint8_t& block : still.pixels) block = random.below(6) > 0 ? 1 : 0;
    const GrayPlane expected =
        reference::least_confidence(map, last, still, {kLeast.usual, kLeast.known, kLeast.fresh});
    for (const int rows : {1, 8, 1 << 20}) {
      EXPECT_TRUE(same_image(expected, chosen(map, last, still, rows))) << width;
    }
  }
}

TEST(Holding, AKnownPixelNeedsLessWhileItsDisparityIsTheSame) {
  for (const int last : {2560, 2560 + 256, 2560 - 256})
    EXPECT_EQ(kLeast.known, least_of(2560, last));
  EXPECT_EQ(kLeast.known, least_of(1, 1)) << "the smallest disparity is not unknown";
}

TEST(Holding, AnotherPixelNeedsMore) {
  for (const int last : {0, 2560 + 265, 2560 - 265}) EXPECT_EQ(kLeast.fresh, least_of(2560, last));
  EXPECT_EQ(kLeast.fresh, least_of(200, 0)) << "unknown is not a disparity near 0";
}

TEST(Holding, NothingIsDecidedBesideWhatMoves) {
  const DisparityPlane map(48, 48, 2560);
  GrayPlane still(6, 6, 1);
  still(2, 3) = 0;
  const GrayPlane least = chosen(map, map, still);
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 48; ++x) {
      const bool beside = x >= 8 && x < 32 && y >= 16 && y < 40;
      ASSERT_EQ(beside ? kLeast.usual : kLeast.known, least(x, y)) << x << ", " << y;
    }
  }
}

TEST(Holding, RemovesWhatHasLessConfidenceThanItNeeds) {
  for (const int rows : {1, 1 << 20}) {
    Image<std::int32_t> map = image_of(DisparityPlane(3, 2, 2560));
    GrayPlane rating(3, 2), needed(3, 2);
    rating.pixels = {59, 60, 255, 1, 0, 150};
    needed.pixels = {60, 60, 60, 1, 1, 151};
    Image<std::uint8_t> confidence = image_of(rating);
    in_bands(rows, 2,
             [&](int y0, int y1) { threshold_each(image_of(needed), y0, y1, map, confidence); });
    EXPECT_EQ((std::vector<std::int32_t>{0, 2560, 2560, 2560, 0, 0}), copy_of(map).pixels);
    EXPECT_EQ((std::vector<std::uint8_t>{0, 60, 255, 1, 0, 0}), copy_of(confidence).pixels);
  }
}

}  // namespace
}  // namespace mtstereo
