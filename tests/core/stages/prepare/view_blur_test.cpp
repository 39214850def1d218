// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/prepare/view_blur.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "reference/prepare/view_blur.hpp"
#include "support/compare.hpp"
#include "support/padded_image.hpp"
#include "support/random.hpp"
#include "support/simd_targets.hpp"

namespace mtstereo::view_blur_test {
namespace {

GrayPlane blurred(GrayView view, const BlurKernel& kernel, int band = 1 << 20) {
  Image<std::uint8_t> out = test::image_of(GrayPlane(view.width, view.height, 77));
  BlurScratch scratch;
  for (int y = 0; y < view.height; y += band) {
    blur_rows(view, kernel, y, std::min(y + band, view.height), scratch, out);
  }
  return test::copy_of(out);
}

TEST(ViewBlur, EqualsReferenceAtAnySizeAndStrideOnEveryInstructionSet) {
  test::for_each_simd_target([] {
    for (int width = 1; width <= 140; width += width < 70 ? 1 : 7) {
      const int height = width % 7 == 0 ? 41 : width % 5 + 1;
      const GrayPlane view = test::noise(width, height, width);
      const BlurKernel kernel = gaussian_kernel(0.3F + 0.1F * static_cast<float>(width % 28));
      const GrayPlane expected = reference::blur(view, kernel);
      const test::PaddedImage<std::uint8_t> padded(view, width % 70, height % 5);
      for (const int band : {1, 7, 1000}) {
        EXPECT_TRUE(same_image(expected, blurred(padded.view(), kernel, band)));
      }
      EXPECT_TRUE(padded.unchanged());
    }
  });
}

TEST(ViewBlur, AcceptsNegativeStrides) {
  const GrayPlane view = test::noise(67, 33, 1);
  GrayPlane upside_down = view;
  for (int y = 0; y < 33; ++y) std::copy_n(&view(0, 32 - y), 67, &upside_down(0, y));
  const test::PaddedImage<std::uint8_t> padded(view, 3);
  const BlurKernel kernel = gaussian_kernel(1);
  EXPECT_TRUE(
      same_image(reference::blur(upside_down, kernel), blurred(padded.upside_down(), kernel)));
}

TEST(ViewBlur, IsNearAnExactGaussian) {
  const GrayPlane view = test::noise(60, 50, 3);
  for (const float sigma : {0.3F, 0.5F, 0.8F, 1.0F, 1.5F, 2.0F, 3.0F}) {
    const GrayPlane out = blurred(view.view(), gaussian_kernel(sigma));
    double worst = 0;
    for (int y = 15; y < 35; ++y) {
      for (int x = 15; x < 45; ++x) {
        double sum = 0, weights = 0;
        for (int j = -15; j <= 15; ++j) {
          for (int i = -15; i <= 15; ++i) {
            const double weight = std::exp(-(i * i + j * j) / (2.0 * sigma * sigma));
            sum += weight * view(x + i, y + j);
            weights += weight;
          }
        }
        worst = std::max(worst, std::abs(sum / weights - out(x, y)));
      }
    }
    EXPECT_LT(worst, 2) << "sigma " << sigma;
  }
}

TEST(ViewBlur, KernelsAddUpToOneAndDecrease) {
  for (int i = 0; i <= 300; ++i) {
    const float sigma = 0.01F * static_cast<float>(i);
    const BlurKernel kernel = gaussian_kernel(sigma);
    int sum = kernel.weights[0];
    for (int k = 1; k <= kLargestBlurRadius; ++k) {
      sum += 2 * kernel.weights[k];
      EXPECT_LE(kernel.weights[k], kernel.weights[k - 1] + 2) << "more than rounding";
      EXPECT_EQ(k <= kernel.radius, kernel.weights[k] > 0);
    }
    EXPECT_EQ(256, sum);
    EXPECT_EQ(sigma < 0.3F, kernel.radius == 0) << sigma;
  }
}

TEST(ViewBlur, KeepsConstantViewsAndTheWholeRangeOfValues) {
  for (const int value : {0, 1, 127, 254, 255}) {
    const GrayPlane view(33, 20, static_cast<std::uint8_t>(value));
    for (const float sigma : {0.0F, 0.4F, 1.3F, 3.0F}) {
      EXPECT_TRUE(same_image(view, blurred(view.view(), gaussian_kernel(sigma))));
    }
  }
}

}  // namespace
}  // namespace mtstereo::view_blur_test
