// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/prepare/halving.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "reference/prepare/halving.hpp"
#include "support/compare.hpp"
#include "support/padded_image.hpp"
#include "support/random.hpp"
#include "support/simd_targets.hpp"

namespace mtstereo::halving_test {
namespace {

constexpr int kWhole = 1 << 20;

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

GrayPlane halved(GrayView view, int band = kWhole) {
  const int height = half_of(view.height);
  Image<std::uint8_t> half = used_image<std::uint8_t>(half_of(view.width), height, 77);
  in_bands(height, band, [&](int y0, int y1) { halve_rows(view, y0, y1, half); });
  return copy_of(half);
}

TEST(Halving, EqualsReferenceAtEverySizeAndStrideOnEveryInstructionSet) {
  test::for_each_simd_target([] {
    for (int width = 1; width <= 150; ++width) {
      for (const int height : {1, 2, 3, 8, 71}) {
        const GrayPlane view = test::noise(width, height, 1000 * width + height);
        const GrayPlane expected = reference::halve(view);
        const test::PaddedImage<std::uint8_t> padded(view, width % 70, height % 5);
        for (const int band : {1, 5, kWhole}) {
          EXPECT_TRUE(same_image(expected, halved(padded.view(), band)));
        }
        EXPECT_TRUE(padded.unchanged());
      }
    }
  });
}

TEST(Halving, AcceptsNegativeStrides) {
  const GrayPlane view = test::noise(67, 33, 1);
  GrayPlane upside_down = view;
  for (int y = 0; y < 33; ++y) std::copy_n(&view(0, 32 - y), 67, &upside_down(0, y));
  const test::PaddedImage<std::uint8_t> padded(view, 3);
  EXPECT_TRUE(same_image(reference::halve(upside_down), halved(padded.upside_down())));
}

TEST(Halving, RoundsTheMeanAtFullContrast) {
  for (int white = 0; white <= 4; ++white) {
    GrayPlane view(2, 2);
    std::fill_n(view.pixels.begin(), white, std::uint8_t{255});
    EXPECT_EQ(std::lround(255 * white / 4.0), halved(view.view())(0, 0));
  }
  EXPECT_TRUE(same_image(GrayPlane(40, 20, 255), halved(GrayPlane(80, 40, 255).view())));
}

TEST(Halving, RepeatsTheLastRowAndColumnOfOddSizes) {
  GrayPlane view(3, 3, 10);
  view(2, 0) = 100;
  view(2, 1) = 201;
  view(0, 2) = 50;
  view(1, 2) = 61;
  view(2, 2) = 203;
  const GrayPlane half = halved(view.view());
  EXPECT_EQ(151, half(1, 0));
  EXPECT_EQ(56, half(0, 1));
  EXPECT_EQ(203, half(1, 1));
}

}  // namespace
}  // namespace mtstereo::halving_test
