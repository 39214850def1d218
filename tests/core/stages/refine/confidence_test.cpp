// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/confidence.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "reference/refine/confidence.hpp"
#include "support/compare.hpp"
#include "support/random_maps.hpp"
#include "support/simd_targets.hpp"
#include "support/stages.hpp"

namespace mtstereo::confidence_test {
namespace {

using test::disparity_noise;
using test::patches;

/// Random peak ratios of a map: 0 at unknown disparities.
GrayPlane random_ratios(const DisparityPlane& map, Random& random) {
  GrayPlane ratio(map.width, map.height);
  for (std::size_t i = 0; i < map.pixels.size(); ++i) {
    const int kind = random.below(6);
    const int value = kind == 0 ? 1 : kind == 1 ? 255 : random.between(1, 255);
    if (map.pixels[i] != 0) ratio.pixels[i] = static_cast<std::uint8_t>(value);
  }
  return ratio;
}

/// The confidence of the pixels that have a ratio in `asked`, or in `ratio` without `asked`.
GrayPlane rated(const DisparityPlane& map, const GrayPlane& ratio, int step = 1, int band = 1 << 20,
                const GrayPlane* asked = nullptr) {
  SupportMap support;
  SupportScratch scratch;
  Image<std::uint8_t> confidence;
  support.resize(map.width, map.height);
  test::poison(support.disparity);
  test::poison(support.ratio);
  scratch.resize(map.width);
  confidence.resize(map.width, map.height);
  const int bands = (map.height + band - 1) / band;
  const auto for_bands = [&](auto&& body) {
    for (int i = bands - 1; i >= 0; --i) body(i * band, std::min((i + 1) * band, map.height));
  };
  for_bands([&](int y0, int y1) { copy_support(image_of(map), image_of(ratio), y0, y1, support); });
  for_bands([&](int y0, int y1) {
    rate_support(support, image_of(asked != nullptr ? *asked : ratio), step, y0, y1, scratch,
                 confidence);
  });
  return copy_of(confidence);
}

void expect_reference(const DisparityPlane& map, Random& random, int band, int step) {
  SCOPED_TRACE(testing::Message() << "step " << step << ", bands of " << band << " rows");
  const GrayPlane ratio = random_ratios(map, random);
  GrayPlane expected = reference::rate_support(map, ratio, step);
  EXPECT_TRUE(same_image(expected, rated(map, ratio, step, band)));
  GrayPlane asked = ratio;
  for (std::size_t i = 0; i < asked.pixels.size(); ++i) {
    if (random.below(4) == 0) continue;
    asked.pixels[i] = expected.pixels[i] = 0;
  }
  EXPECT_TRUE(same_image(expected, rated(map, ratio, step, band, &asked))) << "at selected pixels";
}

void expect_reference(const DisparityPlane& map, Random& random, int band) {
  for (const int step : {1, kSupportStep}) expect_reference(map, random, band, step);
}

TEST(Confidence, EqualsReferenceAtEveryWidthOnEveryInstructionSet) {
  test::for_each_simd_target([] {
    for (int width = 1; width <= 70; ++width) {
      Random random(width);
      const int height = 1 + width % 23;
      expect_reference(patches(width, height, width % 5, width), random, 1 + width % 7);
      expect_reference(disparity_noise(width, height, width % 10, 600, width), random, 32);
    }
  });
}

TEST(Confidence, EqualsReferenceAtEveryHeight) {
  for (int height = 1; height <= 20; ++height) {
    Random random(height);
    for (const int band : {1, 3, 32}) {
      expect_reference(patches(31, height, 1, 50 + height), random, band);
      expect_reference(disparity_noise(1, height, 1, 400, height), random, band);
    }
  }
}

TEST(Confidence, EqualsReferenceAtBothEndsOfTheDisparities) {
  // Disparities that are close modulo 2^16 only, and unknown ones, must not support.
  test::for_each_simd_target([] {
    for (int seed = 0; seed < 6; ++seed) {
      Random random(seed);
      DisparityPlane map = disparity_noise(70, 20, seed, 3000, 200 + seed);
      for (std::int32_t& d : map.pixels) {
        if (d != 0 && random.below(2) == 0) d = test::kLargestDisparity - d;
      }
      expect_reference(map, random, 7);
    }
  });
}

TEST(Confidence, EqualsReferenceOverAllDisparities) {
  // The tolerance is at least 1 px: disparities of a few px, and the smallest and the largest
  // together.
  for (int seed = 0; seed < 10; ++seed) {
    Random random(seed);
    DisparityPlane map = disparity_noise(60, 30, seed, 1500, 100 + seed);
    for (std::int32_t& d : map.pixels) {
      if (d % 2 == 0 && d != 0) d = test::kLargestDisparity - d;
    }
    expect_reference(map, random, 32);
  }
}

TEST(Confidence, IsTheCubeRootOfTheFractionOfSupport) {
  // The fraction is truncated to 1/4096, which is visible at pixels with little support.
  Random random(1);
  for (int seed = 0; seed < 20; ++seed) {
    const DisparityPlane map = patches(50, 40, seed / 2, 200 + seed);
    const GrayPlane ratio = random_ratios(map, random);
    const int step = seed % 4 < 2 ? 1 : kSupportStep;
    const GrayPlane confidence = rated(map, ratio, step);
    for (int y = 0; y < map.height; ++y) {
      for (int x = 0; x < map.width; ++x) {
        if (map(x, y) == 0) continue;
        const double share = reference::support_of(map, ratio, step, x, y).share();
        const double least = 255 * std::cbrt(std::max(share - 1.0 / 4096, 0.0)) - 0.51;
        ASSERT_LE(confidence(x, y), std::max(255 * std::cbrt(share) + 0.51, 1.0)) << x << ", " << y;
        ASSERT_GE(confidence(x, y), std::max(least, 1.0)) << x << ", " << y;
        if (share > 0.003) {
          ASSERT_NEAR(255 * std::cbrt(share), confidence(x, y), 1.5);
        }
      }
    }
  }
}

TEST(Confidence, TruncatesEveryFractionLikeIntegerArithmetic) {
  test::for_each_simd_target([] {
    SupportScratch scratch;
    scratch.resize(255 * 81 + 1);
    for (const int pixels : {5, 9, 10, 15, 18, 20, 25, 27, 36, 45, 54, 63, 72, 81}) {
      for (int count = 0; count <= pixels; ++count) {
        const int width = 255 * count + 1;
        for (int ratio = 0; ratio < width; ++ratio) {
          scratch.count[ratio] = static_cast<std::uint16_t>(count);
          scratch.ratio[ratio] = static_cast<std::uint16_t>(ratio);
        }
        find_support_steps(pixels, width, scratch);
        for (int ratio = 0; ratio < width; ++ratio) {
          const reference::Support support{pixels, count, ratio};
          const long expected = count == 0 ? 0 : support.share_steps() + 1;
          ASSERT_EQ(expected, scratch.steps[ratio])
              << count << " of " << pixels << ", ratios of " << ratio;
        }
      }
    }
  });
}

TEST(Confidence, RoundsAnExactCubeRootHalfUp) {
  // Half of the window supports with the largest ratio: 255 times the cube root of 1/8 is 127.5.
  DisparityPlane map(9, 8);
  GrayPlane ratio(9, 8);
  for (int x = 0; x < 9; ++x) {
    for (int y = 0; y < 8; ++y) {
      map(x, y) = y < 4 ? 2560 : 9000;
      ratio(x, y) = 255;
    }
  }
  EXPECT_EQ(512, reference::support_of(map, ratio, 1, 4, 3).share_steps());
  EXPECT_EQ(128, rated(map, ratio)(4, 3));
}

TEST(Confidence, IsLargestInAUniformMapAndZeroInAnUnknownOne) {
  const DisparityPlane map(30, 20, 2560);
  EXPECT_TRUE(same_image(GrayPlane(30, 20, 255), rated(map, GrayPlane(30, 20, 255))))
      << "also at the border";
  EXPECT_TRUE(same_image(GrayPlane(30, 20), rated(DisparityPlane(30, 20), GrayPlane(30, 20))));
}

TEST(Confidence, IsLeastForAnIsolatedDisparity) {
  DisparityPlane map(30, 20);
  map(15, 10) = 2560;
  GrayPlane ratio(30, 20), expected(30, 20);
  ratio(15, 10) = 255;
  expected(15, 10) = 1;
  EXPECT_TRUE(same_image(expected, rated(map, ratio)));
}

TEST(Confidence, DecreasesTowardsTheBorderOfAKnownArea) {
  DisparityPlane map(40, 20);
  GrayPlane ratio(40, 20);
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 20; ++x) {
      map(x, y) = 2560;
      ratio(x, y) = 200;
    }
  }
  const GrayPlane confidence = rated(map, ratio);
  for (int x = 16; x < 20; ++x) EXPECT_LT(confidence(x, 10), confidence(x - 1, 10)) << x;
  EXPECT_EQ(0, confidence(20, 10));
}

TEST(Confidence, SupportsSlantedSurfacesButNotSteps) {
  const auto middle_of = [](int rise) {
    DisparityPlane map(9, 9);
    for (int y = 0; y < 9; ++y) {
      for (int x = 0; x < 9; ++x) map(x, y) = 256 * 20 + rise * (x - 4);
    }
    return rated(map, GrayPlane(9, 9, 255))(4, 4);
  };
  EXPECT_EQ(255, middle_of(0));
  // (32 + 4 * 13) / 32 px over 4 px are 168 / 256 px per px.
  EXPECT_EQ(255, middle_of(168));
  EXPECT_EQ(255, middle_of(-168));
  EXPECT_LT(middle_of(171), 250);
  EXPECT_LT(middle_of(1000), 60);
}

TEST(Confidence, RemovesDisparitiesBelowTheThresholdOnEveryInstructionSet) {
  test::for_each_simd_target([] {
    for (int width = 1; width <= 70; ++width) {
      const DisparityPlane map = disparity_noise(width, 2, width % 10, 900, width);
      const GrayPlane confidence = test::noise(width, 2, width);
      Image<std::int32_t> image = image_of(map);
      Image<std::uint8_t> values = image_of(confidence);
      threshold_confidence(128, 0, 1, image, values);
      EXPECT_TRUE(test::same_pixels(
          width, 2, [&](int x, int y) { return y == 1 || confidence(x, y) >= 128 ? map(x, y) : 0; },
          [&](int x, int y) { return image.row(y)[x]; }));
      EXPECT_TRUE(test::same_pixels(
          width, 2,
          [&](int x, int y) {
            return y == 1 || confidence(x, y) >= 128 ? int{confidence(x, y)} : 0;
          },
          [&](int x, int y) { return int{values.row(y)[x]}; }));
    }
  });
}

TEST(Confidence, RemovesOnlyDisparitiesBelowTheThreshold) {
  Random random(2);
  const DisparityPlane map = patches(45, 37, 1, 300);
  const GrayPlane confidence = rated(map, random_ratios(map, random));
  for (const int least : {0, 1, 2, 60, 127, 128, 254, 255}) {
    Image<std::int32_t> image = image_of(map);
    Image<std::uint8_t> values = image_of(confidence);
    threshold_confidence(least, 0, 20, image, values);
    threshold_confidence(least, 20, 37, image, values);
    DisparityPlane expected = map;
    GrayPlane expected_values = confidence;
    for (std::size_t i = 0; i < map.pixels.size(); ++i) {
      if (confidence.pixels[i] < least) expected.pixels[i] = expected_values.pixels[i] = 0;
    }
    EXPECT_TRUE(same_image(expected, image)) << "least " << least;
    EXPECT_TRUE(same_image(expected_values, values)) << "least " << least;
  }
}

TEST(Confidence, ChangesOnlyTheGivenRows) {
  const DisparityPlane map(20, 9, 500);
  Image<std::int32_t> image = image_of(map);
  Image<std::uint8_t> values = image_of(GrayPlane(20, 9, 10));
  threshold_confidence(11, 3, 5, image, values);
  for (int y = 0; y < 9; ++y) {
    EXPECT_EQ(y == 3 || y == 4 ? 0 : 500, image.row(y)[7]) << "row " << y;
    EXPECT_EQ(y == 3 || y == 4 ? 0 : 10, values.row(y)[7]) << "row " << y;
  }
}

}  // namespace
}  // namespace mtstereo::confidence_test
