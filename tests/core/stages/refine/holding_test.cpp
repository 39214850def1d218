// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/holding.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "mtstereo/parameters.hpp"
#include "reference/refine/holding.hpp"
#include "support/compare.hpp"
#include "support/random.hpp"
#include "support/simd_targets.hpp"

namespace mtstereo::holding_test {
namespace {

constexpr LeastConfidence kLeast = {140, 110, 150};

/// Calls body(y0, y1) for the bands of an image of this height.
template <typename Body>
void in_bands(int rows, int height, Body body) {
  for (int y = 0; y < height; y += rows) body(y, std::min(y + rows, height));
}

/// The least confidence that each pixel keeps; 0 if it keeps none that is tried.
GrayPlane chosen(const DisparityPlane& map, const DisparityPlane& last, const CameraMotion& motion,
                 float offset = 0, int rows = 1 << 20) {
  Image<std::uint16_t> before;
  before.resize(map.width, map.height);
  in_bands(rows, map.height, [&](int y0, int y1) { copy_last(image_of(last), y0, y1, before); });
  GrayPlane least(map.width, map.height);
  for (const int tried : {150, 149, 140, 139, 110}) {
    Image<std::uint8_t> rating = image_of(GrayPlane(map.width, map.height, tried));
    in_bands(rows, map.height, [&](int y0, int y1) {
      doubt_by_last(kLeast, motion, offset, before, image_of(map), y0, y1, rating);
    });
    for (int y = 0; y < map.height; ++y) {
      for (int x = 0; x < map.width; ++x) {
        const bool keeps = rating.row(y)[x] != 0;
        if (keeps) least(x, y) = static_cast<std::uint8_t>(tried);
        EXPECT_EQ(keeps ? tried : 0, rating.row(y)[x]);
      }
    }
  }
  return least;
}

/// The least confidence of one pixel of a still view, with these disparities [1/256 px].
int least_of(int now, int last) {
  return chosen(DisparityPlane(1, 1, now), DisparityPlane(1, 1, last), {})(0, 0);
}

/// Compares what is left of these confidences with the least ones.
void expect_doubted(const GrayPlane& least, const DisparityPlane& map, const GrayPlane& rating,
                    const DisparityPlane& last, const CameraMotion& motion, float offset) {
  GrayPlane expected = rating;
  for (std::size_t i = 0; i < map.pixels.size(); ++i) {
    const int had = rating.pixels[i];
    if (had >= kLeast.known && had < least.pixels[i]) expected.pixels[i] = 0;
  }
  Image<std::uint16_t> before;
  before.resize(map.width, map.height);
  copy_last(image_of(last), 0, map.height, before);
  Image<std::uint8_t> confidence = image_of(rating);
  doubt_by_last(kLeast, motion, offset, before, image_of(map), 0, map.height, confidence);
  EXPECT_TRUE(same_image(expected, copy_of(confidence))) << map.width;
}

TEST(Holding, ChoosesTheLeastConfidenceOfTheReferenceAtEveryWidthOnEveryInstructionSet) {
  test::for_each_simd_target([] {
    Random random(2);
    for (int width = 1; width <= 600; width += random.between(1, width < 140 ? 3 : 60)) {
      const int height = random.between(1, 19);
      DisparityPlane map(width, height), last(width, height);
      GrayPlane rating(width, height);
      for (std::size_t i = 0; i < map.pixels.size(); ++i) {
        const int any = random.below(random.below(3) == 0 ? 12 : 60 * kDisparityOne);
        map.pixels[i] = random.below(6) == 0 ? any : 30 * kDisparityOne + random.below(600);
        rating.pixels[i] = static_cast<std::uint8_t>(random.between(100, 160));
        if (random.below(4) == 0) continue;
        last.pixels[i] = std::max(map.pixels[i] + random.between(-290, 290), 1);
      }
      const auto term = [&](float most) { return most * random.between(-100, 100) / 100.0F; };
      const CameraMotion motion = {term(3),    term(3),     term(0.05F), term(0.1F),
                                   term(0.1F), term(0.01F), term(0.01F), term(0.01F)};
      const float offset = random.below(2) == 0 ? 0 : -7.5F;
      const GrayPlane expected = reference::least_confidence(
          map, last, motion, offset, {kLeast.usual, kLeast.known, kLeast.fresh});
      for (const int rows : {1, 8, 1 << 20}) {
        EXPECT_TRUE(same_image(expected, chosen(map, last, motion, offset, rows))) << width;
      }
      expect_doubted(expected, map, rating, last, motion, offset);
    }
  });
}

TEST(Holding, AKnownPointNeedsLess) {
  for (const int last : {2560, 2560 + 256, 2560 - 256})
    EXPECT_EQ(kLeast.known, least_of(2560, last));
  EXPECT_EQ(kLeast.known, least_of(1, 1)) << "the smallest disparity is not unknown";
}

TEST(Holding, AnotherPointNeedsWhatItUsuallyDoes) {
  for (const int last : {2560 + 265, 2560 - 265}) EXPECT_EQ(kLeast.usual, least_of(2560, last));
}

TEST(Holding, APointWhereTheLastMapKnowsNothingNeedsMore) {
  EXPECT_EQ(kLeast.fresh, least_of(2560, 0));
  EXPECT_EQ(kLeast.fresh, least_of(200, 0)) << "unknown is not a disparity near 0";
}

TEST(Holding, FollowsTheMotion) {
  const DisparityPlane map(20, 10, 2560);
  DisparityPlane last(20, 10);
  last(12, 4) = 2560;
  const CameraMotion motion = {.shift_x = 7.2F, .shift_y = -2.1F};
  const GrayPlane least = chosen(map, last, motion);
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 20; ++x) {
      const bool known = x == 5 && y == 6, inside = x + 7 < 20 && y >= 2;
      const int expected = known ? kLeast.known : inside ? kLeast.fresh : kLeast.usual;
      ASSERT_EQ(expected, least(x, y)) << x << ", " << y;
    }
  }
}

TEST(Holding, KnowsThePointsOfACameraThatApproaches) {
  // Half of the disparity, and of the distance from the center.
  const DisparityPlane map(9, 9, 2560), last(9, 9, 1280);
  const GrayPlane least = chosen(map, last, {.approach = -0.1F});
  EXPECT_EQ(std::vector<std::uint8_t>(81, kLeast.known), least.pixels);
}

TEST(Holding, WithstandsMotionsWithoutSense) {
  const DisparityPlane map(40, 9, 60 * kDisparityOne);
  for (const float term : {1e30F, -1e30F, std::numeric_limits<float>::quiet_NaN()}) {
    const GrayPlane least = chosen(map, map, {term, term, term, term, term, term, term, term});
    EXPECT_EQ(std::vector<std::uint8_t>(360, kLeast.usual), least.pixels) << term;
  }
}

TEST(Holding, APointBesideANearerSurfaceNeedsNoMore) {
  for (const int jump : {2 * kDisparityOne, 2 * kDisparityOne + 1, -2 * kDisparityOne - 1}) {
    const int expected = jump > kHeldJump ? kLeast.usual : kLeast.fresh;
    for (const auto& [x, y] : {std::pair{1, 5}, {9, 5}, {5, 1}, {5, 9}}) {
      DisparityPlane map(11, 11, 2560);
      map(x, y) += jump;
      EXPECT_EQ(expected, chosen(map, DisparityPlane(11, 11), {}, 0, 2)(5, 5)) << jump;
      EXPECT_EQ(kLeast.known, chosen(map, map, {})(5, 5)) << "a known point needs less";
    }
  }
  DisparityPlane map(11, 11, 2560);
  for (const int i : {0, 10}) map(i, 5) = map(5, i) = 0;
  EXPECT_EQ(kLeast.fresh, chosen(map, DisparityPlane(11, 11), {})(5, 5)) << "5 px away";
}

TEST(Holding, DoubtsWhatHasLessConfidenceThanItNeeds) {
  for (const int rows : {1, 1 << 20}) {
    DisparityPlane last(3, 2, 2560);
    last.pixels[4] = last.pixels[5] = 0;
    Image<std::uint16_t> before;
    before.resize(3, 2);
    copy_last(image_of(last), 0, 2, before);
    const Image<std::int32_t> map = image_of(DisparityPlane(3, 2, 2560));
    GrayPlane rating(3, 2);
    rating.pixels = {109, 110, 255, 0, 149, 150};
    Image<std::uint8_t> confidence = image_of(rating);
    in_bands(rows, 2, [&](int y0, int y1) {
      doubt_by_last(kLeast, {}, 0, before, map, y0, y1, confidence);
    });
    EXPECT_EQ((std::vector<std::uint8_t>{109, 110, 255, 0, 0, 150}), copy_of(confidence).pixels);
  }
}

}  // namespace
}  // namespace mtstereo::holding_test
