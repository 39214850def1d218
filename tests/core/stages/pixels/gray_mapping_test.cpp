// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixels/gray_mapping.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "reference/pixels/gray_mapping.hpp"
#include "support/compare.hpp"
#include "support/plane.hpp"
#include "support/random.hpp"
#include "support/random_maps.hpp"

namespace mtstereo::gray_mapping_test {
namespace {

constexpr int kShift = 7;

/// Views that are shifted by kShift px, and differ by `response`, `noise` at most on both sides.
GrayMapping mapping_of(const std::function<double(double)>& response, int noise,
                       int disparity = kShift * kDisparityOne, int width = 320) {
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
  const Image<std::int32_t> map = image_of(DisparityPlane(width, 200, disparity));
  return find_gray_mapping(left.view(), right.view(), map);
}

GrayPlane mapped_by(const GrayPlane& right, const GrayMapping& mapping) {
  GrayPlane out(right.width, right.height);
  for (int y = 0; y < right.height; ++y) {
    map_row(&right(0, y), right.width, mapping, &out(0, y));
  }
  return out;
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
    const int width = 40 + 5 * seed, height = 10 + seed;
    const DisparityPlane map = test::patches(width, height, 2, seed);
    GrayPlane left(width, height), right(width, height);
    test::Random random(seed);
    for (std::size_t i = 0; i < left.pixels.size(); ++i) {
      const int gray = random.below(20) + static_cast<int>(i) % width;
      left.pixels[i] = static_cast<std::uint8_t>(std::min(gray, 255));
      right.pixels[i] = static_cast<std::uint8_t>(std::min(gray + 9 * (seed % 4), 255));
    }
    const GrayMapping mapping = find_gray_mapping(left.view(), right.view(), image_of(map));
    mapped += !mapping.is_identity;
    const reference::Grays expected = reference::map_grays(left, right, map);
    EXPECT_TRUE(same_image(reference::mapped(right, expected), mapped_by(right, mapping)));
    for (int gray = 0; gray < 256; ++gray) {
      EXPECT_EQ(expected[gray], mapping.of(static_cast<std::uint8_t>(gray)))
          << "gray value " << gray << ", seed " << seed;
    }
  }
  EXPECT_GT(mapped, 10);
  EXPECT_LT(mapped, 60);
}

TEST(GrayMapping, IsNoneWithoutMatchedPixels) {
  const auto darker = [](double gray) { return 0.7 * gray; };
  expect_identity(mapping_of(darker, 0, kNoDisparity));
  expect_identity(mapping_of(darker, 0, kShift * kDisparityOne, 8));
}

}  // namespace
}  // namespace mtstereo::gray_mapping_test
