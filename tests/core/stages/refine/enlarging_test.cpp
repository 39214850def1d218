// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/enlarging.hpp"

#include <gtest/gtest.h>

#include "mtstereo/parameters.hpp"
#include "reference/refine/enlarging.hpp"
#include "stages/prepare/halving.hpp"
#include "support/compare.hpp"
#include "support/random_maps.hpp"
#include "support/simd_targets.hpp"

namespace mtstereo::enlarging_test {
namespace {

constexpr int kWhole = 1 << 20;
constexpr int kFar = 1024;

/// Calls body(y0, y1) for bands of rows from the last to the first.
template <typename Body>
void in_bands(int height, int band, Body&& body) {
  for (int i = (height - 1) / band; i >= 0; --i) body(i * band, std::min(i * band + band, height));
}

/// An image of this size whose pixels all have a value, to be overwritten.
template <typename T>
Image<T> used_image(int width, int height, T value) {
  return test::image_of(test::Plane<T>(width, height, value));
}

DisparityPlane enlarged(const DisparityPlane& half, int width, int height, int max_disparity = kFar,
                        int band = kWhole) {
  const Image<std::int32_t> from = image_of(half);
  Image<std::int32_t> map = used_image<std::int32_t>(width, height, 1 << 30);
  in_bands(height, band, [&](int y0, int y1) { enlarge_rows(from, max_disparity, y0, y1, map); });
  return copy_of(map);
}

GrayPlane enlarged_confidence(const GrayPlane& half, int width, int height, int band = kWhole) {
  const Image<std::uint8_t> from = image_of(half);
  Image<std::uint8_t> confidence = used_image<std::uint8_t>(width, height, 77);
  in_bands(height, band, [&](int y0, int y1) { enlarge_confidence(from, y0, y1, confidence); });
  return copy_of(confidence);
}

/// Limits each disparity to its column, as in every map of a matcher.
DisparityPlane possible(DisparityPlane map) {
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) map(x, y) = std::min(map(x, y), 256 * x);
  }
  return map;
}

void expect_reference(const DisparityPlane& half, int width, int height, int max_disparity) {
  const DisparityPlane expected = reference::enlarge(half, width, height, max_disparity);
  for (const int band : {1, 2, 5, 64, kWhole}) {
    EXPECT_TRUE(same_image(expected, enlarged(half, width, height, max_disparity, band)))
        << "bands of " << band << " rows";
  }
}

TEST(Enlarging, EqualsReferenceAtEverySizeOnEveryInstructionSet) {
  test::for_each_simd_target([] {
    for (int width = 1; width <= 90; ++width) {
      for (const int height : {1, 2, 3, 31, 64}) {
        const int seed = 100 * width + height;
        const DisparityPlane half = test::patches(half_of(width), half_of(height), width % 4, seed);
        expect_reference(possible(half), width, height, kFar);
      }
    }
  });
}

TEST(Enlarging, EqualsReferenceWithWholeVectorsOfUnknownPixels) {
  test::for_each_simd_target([] {
    DisparityPlane half = test::patches(150, 40, 0, 7);
    for (int y = 0; y < 40; ++y) {
      for (int x = 2 * y; x < std::min(2 * y + 66, 150); ++x) half(x, y) = 0;
    }
    expect_reference(possible(half), 299, 79, kFar);
  });
}

TEST(Enlarging, EqualsReferenceOnNoiseOfEveryDensity) {
  for (int of_ten = 0; of_ten <= 10; ++of_ten) {
    // Small disparities, so that most neighbors belong to the same surface, and the largest
    // possible ones.
    for (const int largest : {300, 700, test::kLargestDisparity}) {
      const DisparityPlane half = test::disparity_noise(61, 23, of_ten, largest, of_ten + largest);
      expect_reference(half, 122, 46, 1 << 13);
      expect_reference(possible(half), 121, 45, 97);
    }
  }
}

TEST(Enlarging, ContinuesASlantedPlane) {
  DisparityPlane half(60, 40);
  for (int y = 0; y < 40; ++y) {
    for (int x = 20; x < 60; ++x) half(x, y) = 1000 + 16 * x + 32 * y;
  }
  const DisparityPlane map = enlarged(half, 120, 80);
  // Away from the borders, with a neighbor on each side: the plane at the centers of the pixels.
  for (int y = 1; y < 79; ++y) {
    for (int x = 42; x < 118; ++x) {
      ASSERT_EQ(2 * (1000 + 16 * (2 * x - 1) / 4.0 + 32 * (2 * y - 1) / 4.0), map(x, y));
    }
  }
}

TEST(Enlarging, KeepsDepthEdges) {
  constexpr int kHalf = 128 * 256;
  for (const int step : {257, 5000, -257, -5000}) {
    DisparityPlane half(kHalf / 128, 10, kHalf / 4);
    for (int y = 0; y < 10; ++y) {
      for (int x = 150; x < half.width; ++x) half(x, y) += step;
    }
    const DisparityPlane map = enlarged(half, 2 * half.width, 20);
    for (int y = 0; y < 20; ++y) {
      for (int x = 100; x < 2 * half.width; ++x) {
        ASSERT_EQ(kHalf / 2 + (x < 300 ? 0 : 2 * step), map(x, y)) << "step of " << step;
      }
    }
  }
}

TEST(Enlarging, InterpolatesStepsOfOnePixelOfDisparity) {
  DisparityPlane half(100, 1, 2560);
  for (int x = 50; x < 100; ++x) half(x, 0) = 2560 + 256;
  const DisparityPlane map = enlarged(half, 200, 2);
  for (const int y : {0, 1}) {
    EXPECT_EQ(5120, map(98, y));
    EXPECT_EQ(5120 + 128, map(99, y));
    EXPECT_EQ(5632 - 128, map(100, y));
    EXPECT_EQ(5632, map(101, y));
  }
}

TEST(Enlarging, KeepsTheSetOfKnownPixels) {
  const DisparityPlane half = possible(test::disparity_noise(50, 30, 5, 4000, 3));
  const DisparityPlane map = enlarged(half, 99, 59);
  EXPECT_TRUE(test::same_pixels(
      99, 59, [&](int x, int y) { return half(x / 2, y / 2) != 0; },
      [&](int x, int y) { return map(x, y) != 0; }));
}

TEST(Enlarging, KeepsAPointAtInfinity) {
  DisparityPlane half(20, 10, 1);
  for (int y = 0; y < 10; ++y) half(0, y) = 0;
  const DisparityPlane map = enlarged(half, 40, 20);
  for (int y = 0; y < 20; ++y) {
    for (int x = 2; x < 40; ++x) ASSERT_EQ(2, map(x, y));
  }
}

TEST(Enlarging, NeverExceedsTheColumnOrTheLargestDisparity) {
  // The largest disparity that a half-resolution pixel can have; its neighbor to the right may have
  // a larger one.
  DisparityPlane half(64, 4);
  for (int y = 0; y < 4; ++y) {
    for (int x = 1; x < 64; ++x) half(x, y) = 256 * x;
  }
  for (const int max_disparity : {2, 31, 63, 128}) {
    const DisparityPlane map = enlarged(half, 128, 8, max_disparity);
    for (int y = 0; y < 8; ++y) {
      for (int x = 2; x < 128; ++x) {
        ASSERT_GE(map(x, y), 1);
        ASSERT_LE(map(x, y), 256 * x);
        ASSERT_LT(map(x, y), 256 * max_disparity);
      }
    }
  }
}

TEST(Enlarging, CopiesTheConfidenceOfTheHalfResolutionPixel) {
  for (int width = 1; width <= 140; ++width) {
    for (const int height : {1, 2, 3, 37}) {
      const GrayPlane half = test::noise(half_of(width), half_of(height), width + height);
      const GrayPlane expected = reference::enlarge_confidence(half, width, height);
      for (const int band : {1, 32, kWhole}) {
        EXPECT_TRUE(same_image(expected, enlarged_confidence(half, width, height, band)));
      }
    }
  }
}

TEST(Enlarging, HandlesTheLargestWidthAndHeight) {
  for (const bool wide : {true, false}) {
    const int width = wide ? kLargestImageSide : 3, height = wide ? 3 : kLargestImageSide;
    const DisparityPlane half = test::patches(half_of(width), half_of(height), 1, 9);
    expect_reference(possible(half), width, height, kFar);
  }
}

}  // namespace
}  // namespace mtstereo::enlarging_test
