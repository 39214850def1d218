// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/map_smoothing.hpp"

#include <gtest/gtest.h>

#include "reference/refine/map_smoothing.hpp"
#include "support/compare.hpp"
#include "support/random_maps.hpp"
#include "support/simd_targets.hpp"

namespace mtstereo::map_smoothing_test {
namespace {

using test::disparity_noise;
using test::patches;

constexpr int kWhole = 1 << 20;

/// The smoothed map, computed in bands of `band` rows from the last band to the first.
DisparityPlane smoothed(const DisparityPlane& map, int radius, int band = kWhole) {
  Image<std::int32_t> image = image_of(map);
  Image<std::int32_t> rows = image_of(DisparityPlane(map.width, map.height, 1 << 30));
  SmoothingScratch scratch;
  scratch.resize(map.width, radius);
  const int bands = (map.height + band - 1) / band;
  for (int i = bands - 1; i >= 0; --i) {
    smooth_along_rows(image, radius, i * band, std::min((i + 1) * band, map.height), scratch, rows);
  }
  for (int i = bands - 1; i >= 0; --i) {
    smooth_along_columns(rows, radius, i * band, std::min((i + 1) * band, map.height), scratch,
                         image);
  }
  return copy_of(image);
}

void expect_reference(const DisparityPlane& map, int radius) {
  const DisparityPlane expected = reference::smooth(map, radius);
  for (const int band : {1, 5, 32, kWhole}) {
    EXPECT_TRUE(same_image(expected, smoothed(map, radius, band)))
        << "radius " << radius << ", bands of " << band << " rows";
  }
}

TEST(MapSmoothing, EqualsReferenceAtEveryWidthOnEveryInstructionSet) {
  test::for_each_simd_target([] {
    for (int width = 1; width <= 70; ++width) {
      for (const int radius : {1, 3, 8}) {
        expect_reference(patches(width, 1 + width % 37, width % 5, 10 * width + radius), radius);
      }
    }
  });
}

TEST(MapSmoothing, EqualsReferenceWithWholeVectorsOfUnknownPixels) {
  test::for_each_simd_target([] {
    DisparityPlane map = patches(150, 40, 0, 7);
    for (int y = 0; y < 40; ++y) {
      for (int x = 2 * y; x < std::min(2 * y + 66, 150); ++x) map(x, y) = 0;
    }
    for (const int radius : {1, 5, 31}) expect_reference(map, radius);
  });
}

TEST(MapSmoothing, EqualsReferenceInWideAndNarrowMaps) {
  for (const int length : {255, 256, 257, 511, 513, 700}) {
    for (int side = 1; side <= 4; ++side) {
      expect_reference(patches(length, side, 2, length), 1 + length % 4);
      expect_reference(patches(side, length, 2, length), 1 + length % 4);
    }
  }
}

TEST(MapSmoothing, EqualsReferenceForEveryRadius) {
  for (int radius = 0; radius <= 31; ++radius) {
    expect_reference(patches(47, 40, 0, 100 + radius), radius);
    expect_reference(patches(5, 4, 0, 200 + radius), radius);
  }
}

TEST(MapSmoothing, EqualsReferenceOnNoiseOfEveryDensity) {
  for (int of_ten = 0; of_ten <= 10; ++of_ten) {
    for (const int largest : {200, 400, test::kLargestDisparity}) {
      expect_reference(disparity_noise(52, 45, of_ten, largest, of_ten + largest), 4);
    }
  }
}

TEST(MapSmoothing, KeepsPlanesUpToTheirBorders) {
  DisparityPlane map(80, 50);
  for (int y = 5; y < 44; ++y) {
    for (int x = 20; x < 80; ++x) map(x, y) = 2000 + 40 * x - 25 * y;
  }
  for (const int radius : {1, 3, 6}) EXPECT_TRUE(same_image(map, smoothed(map, radius)));
}

TEST(MapSmoothing, DoesNotMixSurfaces) {
  DisparityPlane map(60, 40, 4000);
  for (int y = 0; y < 40; ++y) {
    for (int x = 30; x < 60; ++x) map(x, y) = 4000 + 257;
  }
  EXPECT_TRUE(same_image(map, smoothed(map, 5)));
}

// Feature: speckle filter, median, filling of gaps
TEST(MapSmoothing, ReducesNoise) {
  const DisparityPlane noise = disparity_noise(90, 70, 0, 200, 1);
  DisparityPlane map = noise;
  for (std::int32_t& d : map.pixels) d += 5000;
  const DisparityPlane smooth = smoothed(map, 3);
  const auto error = [](const DisparityPlane& of) {
    double sum = 0;
    for (const std::int32_t d : of.pixels) sum += std::abs(d - 5100.5);
    return sum / static_cast<double>(of.pixels.size());
  };
  EXPECT_LT(error(smooth), error(map) / 3);
}

TEST(MapSmoothing, KeepsTheSetOfKnownPixelsAndPossibleDisparities) {
  for (int seed = 0; seed < 20; ++seed) {
    DisparityPlane map = disparity_noise(40, 30, 3, 9 * 256, seed);
    for (int y = 0; y < 30; ++y) {
      for (int x = 0; x < 40; ++x) map(x, y) = std::min(map(x, y), 256 * x);
    }
    const DisparityPlane smooth = smoothed(map, 5);
    for (int y = 0; y < 30; ++y) {
      for (int x = 0; x < 40; ++x) {
        ASSERT_EQ(map(x, y) == 0, smooth(x, y) == 0);
        ASSERT_LE(smooth(x, y), 256 * x);
        ASSERT_LE(smooth(x, y), 9 * 256);
      }
    }
  }
}

}  // namespace
}  // namespace mtstereo::map_smoothing_test
