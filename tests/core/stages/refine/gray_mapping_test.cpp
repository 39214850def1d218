// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/gray_mapping.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "reference/refine/gray_mapping.hpp"
#include "support/plane.hpp"
#include "support/random.hpp"
#include "support/random_ratings.hpp"

namespace mtstereo::gray_mapping_test {
namespace {

constexpr int kShift = 7;

/// Views that are shifted by kShift px, and differ by `response`, `noise` at most on both sides.
GrayMapping mapping_of(const std::function<double(double)>& response, int noise,
                       std::uint8_t confidence = 200, int width = 320) {
  GrayPlane left(width, 200), right(width, 200);
  test::Random random(1);
  for (int y = 0; y < 200; ++y) {
    int gray = 100;
    for (int x = 0; x < width; ++x) {
      gray = std::clamp(gray + random.between(-25, 25), 10, 230);
      left(x, y) = static_cast<std::uint8_t>(gray);
      const int partner = x - kShift;
      if (partner < 0) continue;
      const double seen = response(gray) + random.between(-noise, noise);
      right(partner, y) = static_cast<std::uint8_t>(std::clamp(std::lround(seen), 0L, 255L));
    }
  }
  const Image<std::int32_t> map = image_of(DisparityPlane(width, 200, kShift * kDisparityOne));
  const Image<std::uint8_t> confident = image_of(GrayPlane(width, 200, confidence));
  return find_gray_mapping({left.view(), right.view(), 1, nullptr, 16}, map, confident);
}

void expect_identity(const GrayMapping& mapping) { EXPECT_TRUE(mapping.is_identity); }

TEST(GrayMapping, IsNoneForEqualCamerasWithNoise) {
  expect_identity(mapping_of([](double gray) { return gray; }, 0));
  expect_identity(mapping_of([](double gray) { return gray; }, 8));
  expect_identity(mapping_of([](double gray) { return gray + 2; }, 3));
}

TEST(GrayMapping, UndoesAnExposureAndAResponse) {
  const auto darker = [](double gray) { return 0.7 * gray; };
  const auto gamma = [](double gray) { return 255 * std::pow(gray / 255, 1.3); };
  for (const auto& response : {std::function<double(double)>(darker), {gamma}}) {
    const GrayMapping mapping = mapping_of(response, 1);
    EXPECT_FALSE(mapping.is_identity);
    for (int gray = 20; gray <= 220; gray += 10) {
      EXPECT_NEAR(gray, mapping.left_of_right[std::lround(response(gray))], 3) << gray;
    }
  }
}

TEST(GrayMapping, NeverDecreases) {
  const GrayMapping mapping = mapping_of([](double gray) { return 0.6 * gray + 30; }, 1);
  for (int gray = 1; gray < 256; ++gray) {
    EXPECT_GE(mapping.left_of_right[gray], mapping.left_of_right[gray - 1]) << gray;
  }
}

TEST(GrayMapping, TakesOverSmallDifferencesInPart) {
  const GrayMapping mapping = mapping_of([](double gray) { return gray - 4.5; }, 0);
  EXPECT_NEAR(102, mapping.left_of_right[100], 1);
}

TEST(GrayMapping, EqualsReference) {
  int mapped = 0;
  for (int seed = 1; seed <= 60; ++seed) {
    const test::RandomRating rated(40 + 5 * seed, 10 + seed, seed);
    GrayPlane right = rated.right;
    for (std::uint8_t& gray : right.pixels) {
      gray = static_cast<std::uint8_t>(std::min(gray + 9 * (seed % 4), 255));
    }
    RatedViews views = rated.views(1);
    views.right = right.view();
    const GrayMapping mapping =
        find_gray_mapping(views, image_of(rated.in.map), image_of(rated.in.confidence));
    mapped += !mapping.is_identity;
    const reference::Grays expected = reference::map_grays(rated.left, right, rated.in);
    for (int gray = 0; gray < 256; ++gray) {
      EXPECT_EQ(expected[gray], mapping.is_identity ? gray : mapping.left_of_right[gray])
          << "gray value " << gray << ", seed " << seed;
    }
  }
  EXPECT_GT(mapped, 10);
  EXPECT_LT(mapped, 60);
}

TEST(GrayMapping, IsNoneWithoutMatchedPixels) {
  const auto darker = [](double gray) { return 0.7 * gray; };
  expect_identity(mapping_of(darker, 0, kMostInferred));
  expect_identity(mapping_of(darker, 0, 200, 8));
}

}  // namespace
}  // namespace mtstereo::gray_mapping_test
