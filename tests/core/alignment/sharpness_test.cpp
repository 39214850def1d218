// SPDX-License-Identifier: LGPL-2.1-or-later
#include "alignment/sharpness.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/random.hpp"

namespace mtstereo::sharpness_test {
namespace {

constexpr int kWidth = 400, kHeight = 260, kDisparity = 10;

GrayPlane blurred(const GrayPlane& view, float sigma) {
  Image<std::uint8_t> out;
  out.resize(view.width, view.height);
  BlurScratch scratch;
  blur_rows(view.view(), gaussian_kernel(sigma), 0, view.height, scratch, out);
  return test::copy_of(out);
}

GrayPlane noisy(GrayPlane view, int largest, std::uint64_t seed) {
  test::Random random(seed);
  for (std::uint8_t& pixel : view.pixels) {
    const int noise = random.between(-largest, largest) + random.between(-largest, largest);
    pixel = static_cast<std::uint8_t>(std::clamp(pixel + noise, 0, 255));
  }
  return view;
}

/// A pair with flat areas, in which noise can be measured.
test::Pair pair_of(std::uint64_t seed) {
  test::Pair pair = test::shifted_pair(kWidth, kHeight, kDisparity, seed);
  for (GrayPlane* view : {&pair.left, &pair.right}) {
    *view = blurred(*view, 0.5F);
    for (int y = 0; y < 90; ++y) {
      for (int x = 0; x < kWidth; ++x) (*view)(x, y) = static_cast<std::uint8_t>(100 + x / 8);
    }
  }
  return pair;
}

SharpnessDifference compare(const GrayPlane& left, const GrayPlane& right) {
  std::vector<Match> matches;
  for (int y = 110; y < kHeight; y += 15) {
    for (int x = 20; x < kWidth; x += 15) {
      matches.push_back({static_cast<float>(x), static_cast<float>(y),
                         static_cast<float>(x - kDisparity), 0, 0.01F});
    }
  }
  SharpnessScratch scratch;
  return compare_sharpness(left.view(), right.view(), matches, scratch);
}

TEST(Sharpness, IsEqualInEqualViewsWhateverTheirContrast) {
  const test::Pair pair = pair_of(1);
  const SharpnessDifference same = compare(pair.left, pair.right);
  EXPECT_NEAR(1, same.ratio, 0.05);
  EXPECT_TRUE(same.left_blur == 0 && same.right_blur == 0);
  GrayPlane dim = pair.right;
  for (std::uint8_t& pixel : dim.pixels) pixel = static_cast<std::uint8_t>(40 + pixel / 2);
  EXPECT_NEAR(1, compare(pair.left, dim).ratio, 0.05);
}

TEST(Sharpness, FindsTheBlurOfOneView) {
  for (const float sigma : {1.0F, 1.5F, 2.0F}) {
    const test::Pair pair = pair_of(2);
    const SharpnessDifference right = compare(pair.left, blurred(pair.right, sigma));
    EXPECT_NEAR(sigma, right.left_blur, 0.12);
    EXPECT_EQ(0, right.right_blur);
    EXPECT_GT(right.ratio, kSharpnessLimit);
    const SharpnessDifference left = compare(blurred(pair.left, sigma), pair.right);
    EXPECT_NEAR(sigma, left.right_blur, 0.12);
    EXPECT_EQ(0, left.left_blur);
  }
}

TEST(Sharpness, IsNotFakedByNoise) {
  const test::Pair pair = pair_of(3);
  for (const int largest : {3, 8}) {
    const GrayPlane left = noisy(pair.left, largest, 1), right = noisy(pair.right, largest, 2);
    for (const auto& [a, b] :
         {std::pair(&left, &right), std::pair(&left, &pair.right), std::pair(&pair.left, &right)}) {
      const SharpnessDifference difference = compare(*a, *b);
      EXPECT_NEAR(1, difference.ratio, 0.15) << largest;
      EXPECT_TRUE(difference.left_blur == 0 && difference.right_blur == 0);
    }
  }
}

TEST(Sharpness, MeasuresNoise) {
  SharpnessScratch scratch;
  EXPECT_NEAR(0, noise_of(pair_of(4).left.view(), scratch), 0.6);
  for (const int largest : {3, 8}) {
    // The sum of two uniform numbers.
    const double deviation = std::sqrt(2 * largest * (largest + 1) / 3.0);
    const GrayPlane view = noisy(pair_of(4).left, largest, 3);
    EXPECT_NEAR(deviation, noise_of(view.view(), scratch), 0.25 * deviation);
  }
  EXPECT_EQ(0, noise_of(GrayPlane(9, 9, 3).view(), scratch));
  EXPECT_EQ(0, noise_of(GrayPlane(300, 200, 3).view(), scratch));
}

TEST(Sharpness, MeasuresNoiseWhereViewsAreNotClipped) {
  constexpr int kLargest = 6;
  const double deviation = std::sqrt(2.0 * kLargest * (kLargest + 1) / 3);
  SharpnessScratch scratch;
  for (const int clipped : {0, 255}) {
    GrayPlane view(kWidth, kHeight, 120);
    for (int y = kHeight / 2; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) view(x, y) = static_cast<std::uint8_t>(clipped);
    }
    EXPECT_NEAR(deviation, noise_of(noisy(view, kLargest, 5).view(), scratch), 0.25 * deviation);
  }
}

TEST(Sharpness, NeedsPatchesWithContrast) {
  const test::Pair pair = pair_of(5);
  SharpnessScratch scratch;
  const std::vector<Match> few(kFewestPatches - 1, Match{100, 150, 90, 0, 0.01F});
  EXPECT_EQ(0, compare_sharpness(pair.left.view(), pair.right.view(), few, scratch).ratio);
  EXPECT_EQ(0, compare(GrayPlane(kWidth, kHeight, 9), GrayPlane(kWidth, kHeight, 9)).ratio);
  std::vector<Match> outside(100, Match{3, 150, -40, 0, 0.01F});
  EXPECT_EQ(0, compare_sharpness(pair.left.view(), pair.right.view(), outside, scratch).ratio);
}

TEST(Sharpness, SpreadsPatchesOverTheImage) {
  std::vector<Match> places;
  spread_patches(kWidth, kHeight, places);
  EXPECT_GT(places.size(), 200u);
  for (const Match& place : places) {
    EXPECT_TRUE(place.x_left >= 0 && place.x_left < kWidth && place.y_left < kHeight);
    EXPECT_EQ(place.x_left, place.x_right);
  }
}

}  // namespace
}  // namespace mtstereo::sharpness_test
