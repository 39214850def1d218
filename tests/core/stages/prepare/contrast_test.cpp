// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/prepare/contrast.hpp"

#include <gtest/gtest.h>

#include "reference/prepare/contrast.hpp"
#include "support/random.hpp"

namespace mtstereo::contrast_test {
namespace {

int range_of(const GrayPlane& view, int band = 1 << 20) {
  GrayHistogram grays;
  for (int y = 0; y < view.height; y += band) {
    grays.add(count_grays(view.view(), y, std::min(y + band, view.height)));
  }
  return grays.range();
}

TEST(Contrast, HasTheRangeOfTheSortedValuesAtEverySizeAndBand) {
  test::Random random(1);
  for (int i = 0; i < 500; ++i) {
    GrayPlane view(random.between(1, 40), random.between(1, 40));
    const int low = random.below(256), high = random.between(low, 255);
    for (std::uint8_t& pixel : view.pixels) {
      pixel = static_cast<std::uint8_t>(random.between(low, high));
    }
    for (const int band : {1, 7, 32}) ASSERT_EQ(reference::gray_range(view), range_of(view, band));
  }
}

TEST(Contrast, IgnoresFewBrightAndDarkPixels) {
  GrayPlane view(100, 4, 90);
  for (int x = 0; x < 5; ++x) view(x, 0) = 255, view(99 - x, 0) = 0;
  EXPECT_EQ(0, range_of(view));
  for (int x = 5; x < 12; ++x) view(x, 0) = 110;
  EXPECT_EQ(20, range_of(view));
  EXPECT_EQ(0, GrayHistogram().range() % 255) << "no pixels";
}

}  // namespace
}  // namespace mtstereo::contrast_test
