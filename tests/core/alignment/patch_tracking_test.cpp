// SPDX-License-Identifier: LGPL-2.1-or-later
#include "alignment/patch_tracking.hpp"

#include <gtest/gtest.h>

#include "support/field_pair.hpp"
#include "support/padded_image.hpp"

namespace mtstereo::patch_tracking_test {
namespace {

test::FieldPair still(double disparity, double rows) {
  test::FieldPair options;
  options.width = 80;
  options.height = 60;
  options.disparity = disparity;
  options.slant = 0;
  options.field.offset = rows;
  return options;
}

TEST(PatchTracking, FindsFractionsOfAPixel) {
  for (const double rows : {-1.3, -0.5, 0.0, 0.25, 0.9}) {
    for (const double disparity : {3.0, 4.4, 5.75}) {
      const test::Pair pair = test::taken_as(still(disparity, rows));
      const auto match = track_patch(pair.left.view(), pair.right.view(), 40, 30, 35, 30, 3);
      ASSERT_TRUE(match.has_value()) << disparity << ", " << rows;
      EXPECT_NEAR(rows, match->rows, 0.03);
      EXPECT_NEAR(disparity, match->disparity(), 0.03);
      EXPECT_GE(match->variance, kSmallestDeviation * kSmallestDeviation);
    }
  }
}

TEST(PatchTracking, DoesNotDependOnContrastAndBrightness) {
  test::FieldPair options = still(5, 0.4);
  options.right_gain = 0.4;
  const test::Pair pair = test::taken_as(options);
  const auto match = track_patch(pair.left.view(), pair.right.view(), 40, 30, 35, 30, 3);
  ASSERT_TRUE(match.has_value());
  EXPECT_NEAR(0.4, match->rows, 0.03);
}

TEST(PatchTracking, PredictsItsErrorUnderNoise) {
  double squares = 0, variances = 0;
  constexpr int kPairs = 60;
  for (int seed = 1; seed <= kPairs; ++seed) {
    test::FieldPair options = still(5, 0.3);
    options.noise = 15;
    options.seed = seed;
    const test::Pair pair = test::taken_as(options);
    const auto match = track_patch(pair.left.view(), pair.right.view(), 40, 30, 35, 30, 3);
    ASSERT_TRUE(match.has_value()) << seed;
    squares += (match->rows - 0.3) * (match->rows - 0.3);
    variances += match->variance;
  }
  EXPECT_GT(variances, squares / 2);
  EXPECT_LT(variances, squares * 2);
}

TEST(PatchTracking, RefusesWhatItCannotLocate) {
  const test::Pair pair = test::taken_as(still(5, 0));
  const GrayPlane flat(80, 60, 100), other = test::noise(80, 60, 3);
  EXPECT_FALSE(track_patch(flat.view(), flat.view(), 40, 30, 35, 30, 3)) << "flat";
  EXPECT_FALSE(track_patch(pair.left.view(), flat.view(), 40, 30, 35, 30, 3))
      << "flat on the right";
  EXPECT_FALSE(track_patch(pair.left.view(), other.view(), 40, 30, 35, 30, 3)) << "unrelated";
  EXPECT_FALSE(track_patch(pair.left.view(), pair.right.view(), 40, 30, 25, 30, 3)) << "far away";
  GrayPlane edges(80, 60);
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 80; ++x) edges(x, y) = x / 8 % 2 == 0 ? 50 : 200;
  }
  EXPECT_FALSE(track_patch(edges.view(), edges.view(), 40, 30, 40, 30, 3)) << "only along rows";
}

TEST(PatchTracking, StaysInsideTheViews) {
  const test::Pair pair = test::taken_as(still(0, 0));
  const test::PaddedImage<std::uint8_t> left(pair.left, 3), right(pair.right, 5);
  for (int y = -2; y < 62; ++y) {
    for (int x = -2; x < 82; ++x) {
      const auto match = track_patch(left.view(), right.view(), x, y, static_cast<float>(x),
                                     static_cast<float>(y), 3);
      const bool inside = x >= 9 && y >= 9 && x < 71 && y < 51;
      EXPECT_TRUE(inside || !match.has_value()) << x << ", " << y;
    }
  }
}

}  // namespace
}  // namespace mtstereo::patch_tracking_test
