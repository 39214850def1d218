// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/prepare/contrast.hpp"

#include <gtest/gtest.h>

#include "reference/prepare/contrast.hpp"
#include "support/random.hpp"

namespace mtstereo::contrast_test {
namespace {

GrayHistogram grays_of(const GrayPlane& view, int band = 1 << 20) {
  GrayHistogram grays;
  for (int y = 0; y < view.height; y += band) {
    grays.add(count_grays(view.view(), y, std::min(y + band, view.height)));
  }
  return grays;
}

TEST(Contrast, EqualsReferenceAtEverySizeAndBand) {
  test::Random random(1);
  for (int i = 0; i < 500; ++i) {
    GrayPlane view(random.between(1, 40), random.between(1, 40));
    const int low = random.below(256), high = random.between(low, 255);
    for (std::uint8_t& pixel : view.pixels) {
      pixel = static_cast<std::uint8_t>(random.between(low, high));
    }
    for (const int band : {1, 7, 32}) {
      const GrayHistogram grays = grays_of(view, band);
      ASSERT_EQ(reference::gray_range(view), grays.range());
      ASSERT_EQ(reference::clipped_from(view), grays.clipped_from());
    }
  }
}

TEST(Contrast, IgnoresFewBrightAndDarkPixels) {
  GrayPlane view(100, 4, 90);
  for (int x = 0; x < 5; ++x) view(x, 0) = 255, view(99 - x, 0) = 0;
  EXPECT_EQ(0, grays_of(view).range());
  for (int x = 5; x < 12; ++x) view(x, 0) = 110;
  EXPECT_EQ(20, grays_of(view).range());
  EXPECT_EQ(0, GrayHistogram().range() % 255) << "no pixels";
}

TEST(Contrast, FindsClippedPixels) {
  GrayPlane view(100, 40, 90);
  for (int x = 0; x < 9; ++x) view(x, 0) = 235;
  EXPECT_EQ(kNothingClipped, grays_of(view).clipped_from()) << "a few highlights";
  view(9, 0) = 233;  // of 1000 pixels that are counted
  EXPECT_EQ(233, grays_of(view).clipped_from());
  view(50, 0) = 255;
  EXPECT_EQ(kNothingClipped, grays_of(view).clipped_from()) << "one of a thousand is brighter";
  EXPECT_EQ(88, grays_of(GrayPlane(9, 9, 90)).clipped_from()) << "a view of one gray value";
  EXPECT_EQ(kNothingClipped, GrayHistogram().clipped_from()) << "no pixels";
}

}  // namespace
}  // namespace mtstereo::contrast_test
