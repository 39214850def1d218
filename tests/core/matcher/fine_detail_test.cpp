// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/fine_detail.hpp"

#include <gtest/gtest.h>

#include "matcher/resolution_choice.hpp"
#include "reference/fine_detail.hpp"
#include "support/plane.hpp"
#include "support/soft_pair.hpp"

namespace mtstereo::fine_detail_test {
namespace {

/// Views and their map.
struct Matched {
  GrayPlane left, right;
  DisparityPlane disparity;
  GrayPlane confidence;
  int offset = 0;

  FineDetail measure(int band = 1 << 20) const {
    FineDetail sums;
    const DetailViews views = {left.view(), right.view(), disparity.view(), confidence.view(),
                               offset};
    for (int y = 0; y < left.height; y += band) {
      const FineDetail part = measure_detail(views, y, std::min(y + band, left.height));
      sums.fine += part.fine;
      sums.coarse += part.coarse;
      sums.points += part.points;
    }
    return sums;
  }
};

GrayPlane white_noise(int width, int height, std::uint64_t seed) {
  test::Random random(seed);
  GrayPlane image(width, height);
  for (std::uint8_t& pixel : image.pixels)
    pixel = static_cast<std::uint8_t>(random.below(200) + 20);
  return image;
}

/// A plane at `disparity` px, all of it matched.
Matched plane_at(const GrayPlane& left, int disparity) {
  Matched made{left, GrayPlane(left.width, left.height),
               DisparityPlane(left.width, left.height, disparity * kDisparityOne),
               GrayPlane(left.width, left.height, 200)};
  for (int y = 0; y < left.height; ++y) {
    for (int x = 0; x < left.width; ++x) made.right(x, y) = left.clamped(x + disparity, y);
  }
  return made;
}

void add_noise(int amount, std::uint64_t seed, GrayPlane& image) {
  test::Random random(seed);
  for (std::uint8_t& pixel : image.pixels) {
    pixel = static_cast<std::uint8_t>(std::clamp(pixel + random.between(-amount, amount), 0, 255));
  }
}

TEST(FineDetail, EqualsTheSumsOfItsPointsAtEveryWidthAndBand) {
  test::Random random(1);
  for (int width = 1; width <= 60; ++width) {
    for (const int offset : {0, -9}) {
      Matched in = plane_at(white_noise(width, 21, width), 0);
      in.right = white_noise(width, 21, width + 100);
      in.offset = offset;
      for (std::int32_t& value : in.disparity.pixels) value = random.between(0, 20 * kDisparityOne);
      for (std::uint8_t& value : in.confidence.pixels) {
        value = static_cast<std::uint8_t>(random.below(60));
      }
      const FineDetail sums =
          reference::measure_detail(in.left, in.right, {in.disparity, in.confidence}, in.offset);
      for (const int band : {1, 3, 32}) {
        const FineDetail measured = in.measure(band);
        EXPECT_EQ(sums.points, measured.points) << width << ", band " << band;
        EXPECT_EQ(sums.fine, measured.fine) << width << ", band " << band;
        EXPECT_EQ(sums.coarse, measured.coarse) << width << ", band " << band;
      }
    }
  }
}

TEST(FineDetail, TellsSharpViewsFromSoftOnes) {
  const GrayPlane sharp = white_noise(200, 100, 1);
  const GrayPlane soft = test::softened(sharp);
  ASSERT_TRUE(plane_at(sharp, 7).measure().share());
  EXPECT_NEAR(1, *plane_at(sharp, 7).measure().share(), 0.1) << "white noise";
  EXPECT_LT(*plane_at(soft, 7).measure().share(), ResolutionChoice::kSoft);
}

TEST(FineDetail, IsNotThatOfTheNoiseOfTheViews) {
  for (const bool soft : {false, true}) {
    const GrayPlane scene = white_noise(400, 200, 2);
    Matched matched = plane_at(soft ? test::softened(scene) : scene, 7);
    const double clean = *matched.measure().share();
    add_noise(12, 3, matched.left);
    add_noise(12, 4, matched.right);
    EXPECT_NEAR(clean, *matched.measure().share(), 0.02) << soft;
  }
}

TEST(FineDetail, IsNeverNegative) {
  Matched matched = plane_at(white_noise(200, 100, 5), 7);
  for (int y = 0; y < 100; ++y) {  // what is coarse in common, what is fine with opposite signs
    for (int x = 0; x < 200; ++x) {
      matched.left(x, y) = static_cast<std::uint8_t>(100 + (x / 4 % 2) * 20 + (x % 2) * 30);
      matched.right(x, y) = static_cast<std::uint8_t>(100 + (x / 4 % 2) * 20 - (x % 2) * 30);
    }
  }
  matched.disparity = DisparityPlane(200, 100, 8 * kDisparityOne);
  ASSERT_LT(matched.measure().fine, 0);
  EXPECT_EQ(0, matched.measure().share());
}

TEST(FineDetail, IsUnknownWithoutPointsOrTexture) {
  const Matched good = plane_at(white_noise(200, 100, 6), 7);
  ASSERT_TRUE(good.measure().share());

  Matched unknown = good;
  unknown.disparity = DisparityPlane(200, 100, kNoDisparity);
  EXPECT_EQ(0, unknown.measure().points);
  EXPECT_FALSE(unknown.measure().share());

  Matched inferred = good;
  inferred.confidence = GrayPlane(200, 100, kMostInferred);
  EXPECT_EQ(0, inferred.measure().points);

  Matched between = good;
  between.disparity = DisparityPlane(200, 100, 7 * kDisparityOne + kNearlyWhole + 1);
  EXPECT_EQ(0, between.measure().points);

  Matched outside = good;
  outside.disparity = DisparityPlane(200, 100, 199 * kDisparityOne);
  EXPECT_EQ(0, outside.measure().points);

  EXPECT_FALSE(plane_at(GrayPlane(200, 100, 90), 7).measure().share()) << "no texture";
  EXPECT_FALSE(plane_at(white_noise(30, 20, 7), 7).measure().share()) << "few points";
}

TEST(FineDetail, ReadsTheRightViewBeyondNegativeDisparities) {
  Matched matched = plane_at(white_noise(200, 100, 8), -5);
  matched.offset = -20;
  matched.disparity = DisparityPlane(200, 100, 15 * kDisparityOne);
  ASSERT_TRUE(matched.measure().share());
  EXPECT_NEAR(1, *matched.measure().share(), 0.1);
}

}  // namespace
}  // namespace mtstereo::fine_detail_test
