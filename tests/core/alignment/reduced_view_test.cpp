// SPDX-License-Identifier: LGPL-2.1-or-later
#include "alignment/reduced_view.hpp"

#include <gtest/gtest.h>

#include "support/compare.hpp"
#include "support/padded_image.hpp"
#include "support/random.hpp"
#include "support/simd_targets.hpp"

namespace mtstereo::reduced_view_test {
namespace {

/// The same, pixel by pixel.
GrayPlane reduced(const GrayPlane& view) {
  const int factor = reduction_factor(view.width);
  const int width = view.width / factor, height = view.height / factor;
  test::Plane<int> means(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      int sum = 0;
      for (int i = 0; i < factor * factor; ++i) {
        sum += view(x * factor + i % factor, y * factor + i / factor);
      }
      means(x, y) = (4 * sum + factor * factor) / (2 * factor * factor);
    }
  }
  GrayPlane out(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      int sum = 0, count = 0;
      for (int j = std::max(y - 7, 0); j <= std::min(y + 7, height - 1); ++j) {
        for (int i = std::max(x - 7, 0); i <= std::min(x + 7, width - 1); ++i, ++count) {
          sum += means(i, j);
        }
      }
      out(x, y) = static_cast<std::uint8_t>(std::clamp(128 + means(x, y) - sum / count, 0, 255));
    }
  }
  return out;
}

TEST(ReducedView, EqualsThePlainVersionOnEveryInstructionSet) {
  for (const auto& [width, height] :
       {std::pair(96, 64), std::pair(131, 70), std::pair(970, 41), std::pair(1933, 66)}) {
    const GrayPlane view = test::texture(width, height, width);
    const test::PaddedImage<std::uint8_t> padded(view, 13, 3);
    const GrayPlane expected = reduced(view);
    test::for_each_simd_target([&] {
      ReducedView reduced_view;
      reduced_view.reduce(padded.view());
      EXPECT_TRUE(same_image(expected, reduced_view.gray));
    });
    EXPECT_TRUE(padded.unchanged());
  }
}

TEST(ReducedView, IsAboutAsWideForAllImages) {
  EXPECT_EQ(1, reduction_factor(96));
  EXPECT_EQ(1, reduction_factor(640));
  EXPECT_EQ(2, reduction_factor(1242));
  EXPECT_EQ(3, reduction_factor(1920));
  EXPECT_EQ(26, reduction_factor(16384));
}

TEST(ReducedView, DoesNotDependOnBrightness) {
  GrayPlane dark = test::texture(200, 100, 1), bright = dark;
  for (std::uint8_t& pixel : dark.pixels) pixel = static_cast<std::uint8_t>(pixel / 2);
  for (std::size_t i = 0; i < dark.pixels.size(); ++i) {
    bright.pixels[i] = static_cast<std::uint8_t>(dark.pixels[i] + 100);
  }
  ReducedView a, b;
  a.reduce(dark.view());
  b.reduce(bright.view());
  EXPECT_TRUE(same_image(test::copy_of(a.gray), b.gray));
}

}  // namespace
}  // namespace mtstereo::reduced_view_test
