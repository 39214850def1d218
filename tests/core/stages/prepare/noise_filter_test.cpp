// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/prepare/noise_filter.hpp"

#include <gtest/gtest.h>

#include "reference/prepare/noise_filter.hpp"
#include "support/compare.hpp"
#include "support/padded_image.hpp"
#include "support/random.hpp"
#include "support/simd_targets.hpp"

namespace mtstereo::noise_filter_test {
namespace {

/// The filtered view, in bands of `band` rows from the last band to the first.
GrayPlane filtered(GrayView view, float threshold, int band = 1 << 20) {
  Image<std::uint8_t> out = test::image_of(GrayPlane(view.width, view.height, 77));
  NoiseFilterScratch scratch;
  for (int i = (view.height - 1) / band; i >= 0; --i) {
    filter_noise(view, threshold, i * band, std::min(i * band + band, view.height), scratch, out);
  }
  return test::copy_of(out);
}

TEST(NoiseFilter, EqualsReferenceAtEverySizeAndStrideOnEveryInstructionSet) {
  test::for_each_simd_target([] {
    for (int width = 1; width <= 140; width += 1 + width / 20) {
      for (const int height : {1, 2, 9, 40}) {
        const GrayPlane view = test::noise(width, height, 100 * width + height, 100);
        const float threshold = static_cast<float>(width % 40);
        const GrayPlane expected = reference::filter_noise(view, threshold);
        const test::PaddedImage<std::uint8_t> padded(view, width % 70, height % 5);
        for (const int band : {1, 5, 1 << 20}) {
          EXPECT_TRUE(same_image(expected, filtered(padded.view(), threshold, band)))
              << width << "x" << height << ", bands of " << band << " rows";
        }
        EXPECT_TRUE(padded.unchanged());
      }
    }
  });
}

TEST(NoiseFilter, EqualsReferenceAtExtremes) {
  const GrayPlane view = test::black_and_white(150, 30, 5);
  for (const float threshold : {0.0F, 0.5F, 3.0F, 100.0F, 1000.0F}) {
    EXPECT_TRUE(
        same_image(reference::filter_noise(view, threshold), filtered(view.view(), threshold)));
  }
}

TEST(NoiseFilter, SmoothsLightlyAsWithAThresholdOfZero) {
  for (int width = 1; width <= 140; width += 1 + width / 20) {
    for (const int height : {1, 2, 9}) {
      const GrayPlane view = test::noise(width, height, 100 * width + height, 255);
      const test::PaddedImage<std::uint8_t> padded(view, width % 70, height % 5);
      Image<std::uint8_t> out = test::image_of(GrayPlane(width, height, 77));
      NoiseFilterScratch scratch;
      for (int y = height - 1; y >= 0; --y) {
        smooth_lightly(padded.view(), y, y + 1, scratch, out);
      }
      EXPECT_TRUE(same_image(reference::filter_noise(view, 0), test::copy_of(out)))
          << width << "x" << height;
    }
  }
}

TEST(NoiseFilter, LeavesAFlatViewAlone) {
  for (const int gray : {0, 1, 100, 255}) {
    const GrayPlane view(50, 20, static_cast<std::uint8_t>(gray));
    EXPECT_TRUE(same_image(view, filtered(view.view(), 3)));
  }
}

TEST(NoiseFilter, SmoothsNoiseAndKeepsEdges) {
  GrayPlane view(60, 40, 60);
  for (int y = 0; y < 40; ++y) {
    for (int x = 30; x < 60; ++x) view(x, y) = 190;
  }
  test::Random random(1);
  for (std::uint8_t& gray : view.pixels) {
    gray = static_cast<std::uint8_t>(gray + random.between(-6, 6));
  }
  const GrayPlane out = filtered(view.view(), 12);
  double before = 0, after = 0;
  for (int y = 5; y < 35; ++y) {
    for (int x = 5; x < 22; ++x) {
      before += (view(x, y) - 60) * (view(x, y) - 60);
      after += (out(x, y) - 60) * (out(x, y) - 60);
    }
    EXPECT_LT(out(28, y), 90);
    EXPECT_GT(out(31, y), 160);
  }
  EXPECT_LT(after, 0.25 * before);
}

TEST(NoiseThreshold, GrowsWithTheNoiseAndForCompressedViews) {
  EXPECT_FLOAT_EQ(3, noise_threshold(1));
  EXPECT_FLOAT_EQ(30, noise_threshold(10));
  EXPECT_FLOAT_EQ(1.05F, noise_threshold(0.35F));
  EXPECT_FLOAT_EQ(40, noise_threshold(0));
  EXPECT_GT(noise_threshold(0.1F), noise_threshold(0.2F));
}

TEST(NoiseThreshold, GrowsWithTheVisibilityOfBlocks) {
  EXPECT_EQ(0, compression_threshold(0));
  EXPECT_EQ(0, compression_threshold(1.1)) << "views without blocks have up to this much";
  EXPECT_NEAR(3, compression_threshold(1.3), 0.01);
  EXPECT_FLOAT_EQ(6, compression_threshold(1.5));
  EXPECT_FLOAT_EQ(6, compression_threshold(100));
}

}  // namespace
}  // namespace mtstereo::noise_filter_test
