// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/prepare/noise_level.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "reference/prepare/noise_filter.hpp"
#include "support/padded_image.hpp"
#include "support/random.hpp"
#include "support/simd_targets.hpp"

namespace mtstereo::noise_level_test {
namespace {

/// The level, measured in bands of `band` rows from the last band to the first.
float level_of(GrayView view, int band = 1 << 20) {
  NoiseBlocks blocks;
  blocks.resize(view.width, view.height);
  for (int i = (view.height - 1) / band; i >= 0; --i) {
    measure_blocks(view, i * band, std::min(i * band + band, view.height), blocks);
  }
  return noise_level(blocks);
}

/// Adds normally distributed noise.
GrayPlane with_noise(GrayPlane view, double deviation, std::uint32_t seed) {
  std::mt19937 random(seed);
  // The sum of twelve uniform values has the variance 1, and is the same on every platform.
  for (std::uint8_t& gray : view.pixels) {
    double value = -6;
    for (int i = 0; i < 12; ++i) value += static_cast<double>(random()) / 4294967296.0;
    gray = static_cast<std::uint8_t>(std::clamp(std::lround(gray + deviation * value), 0L, 255L));
  }
  return view;
}

TEST(NoiseLevel, EqualsReferenceAtEverySizeAndStrideOnEveryInstructionSet) {
  test::for_each_simd_target([] {
    for (int width = 1; width <= 90; width += 1 + width % 3) {
      for (const int height : {1, 17, 18, 40, 99}) {
        const GrayPlane view = test::noise(width, height, 100 * width + height);
        const test::PaddedImage<std::uint8_t> padded(view, width % 70, height % 5);
        for (const int band : {1, 5, 32, 1 << 20}) {
          EXPECT_EQ(reference::noise_level(view), level_of(padded.view(), band))
              << width << "x" << height << ", bands of " << band;
        }
      }
    }
  });
}

TEST(NoiseLevel, EqualsReferenceAtExtremes) {
  const GrayPlane view = test::black_and_white(70, 70, 3);
  EXPECT_EQ(reference::noise_level(view), level_of(view.view()));
  GrayPlane stripes(70, 70);  // the largest magnitudes, without saturation
  for (int y = 0; y < 70; ++y) {
    for (int x = 0; x < 70; ++x) stripes(x, y) = (x + y) % 2 == 0 ? 2 : 253;
  }
  EXPECT_EQ(reference::noise_level(stripes), level_of(stripes.view()));
  EXPECT_GT(level_of(stripes.view()), 100);
}

TEST(NoiseLevel, IsTheDeviationOfWhiteNoise) {
  for (const double deviation : {1.0, 2.0, 5.0, 10.0}) {
    const GrayPlane view = with_noise(GrayPlane(320, 240, 120), deviation, 1);
    EXPECT_NEAR(deviation, level_of(view.view()), 0.08 * deviation);
  }
}

TEST(NoiseLevel, IgnoresSlopesAndSaturatedAreas) {
  GrayPlane view(320, 240);
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 320; ++x) view(x, y) = static_cast<std::uint8_t>(40 + x / 4 + y / 3);
  }
  view = with_noise(view, 3, 2);
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 320; ++x) view(x, y) = 255;
  }
  EXPECT_NEAR(3, level_of(view.view()), 0.3);
}

TEST(NoiseLevel, IsZeroWithoutABlock) {
  EXPECT_EQ(0, level_of(test::noise(17, 100, 1).view()));
  EXPECT_EQ(0, level_of(test::noise(100, 17, 1).view()));
  EXPECT_EQ(0, level_of(GrayPlane(100, 100, 255).view()));
}

}  // namespace
}  // namespace mtstereo::noise_level_test
