// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/census.hpp"

#include <gtest/gtest.h>

#include "reference/census.hpp"
#include "support/census.hpp"
#include "support/compare.hpp"
#include "support/padded_image.hpp"

namespace mtstereo {
namespace {

using test::bits_of;
using test::census_of;
using test::GrayPlane;
using test::Random;

/// Compares both orders with the reference, in bands; `beyond` columns more repeat the last one.
void expect_reference(const GrayPlane& image, GrayView view, int beyond, int band) {
  const test::Plane<std::uint32_t> expected = reference::census(image);
  const int width = image.width;
  for (const CensusOrder order : {CensusOrder::kForward, CensusOrder::kMirrored}) {
    const bool mirrored = order == CensusOrder::kMirrored;
    const CensusImage census = census_of(view, order, beyond, band);
    const test::Plane<std::uint32_t> actual = bits_of(census, width + beyond);
    EXPECT_EQ(width, census.width);
    EXPECT_TRUE(test::same_pixels(
        width + beyond, image.height,
        [&](int x, int y) {
          const int column = std::min(x, width - 1);
          return expected(mirrored ? width - 1 - column : column, y);
        },
        [&](int x, int y) { return actual(x, y); }))
        << (mirrored ? "mirrored" : "forward") << ", " << beyond << " beyond, bands of " << band;
  }
}

TEST(Census, EqualsReferenceAtEverySize) {
  for (int width = 1; width <= 70; ++width) {
    for (int height = 1; height <= 9; ++height) {
      const GrayPlane image = test::noise(width, height, 100 * width + height, 6);
      expect_reference(image, image.view(), width % 3 * 32, 1 + (width + height) % 5);
    }
  }
}

TEST(Census, EqualsReferenceInEveryBand) {
  const GrayPlane image = test::texture(45, 40, 1);
  for (int band = 1; band <= 41; ++band) expect_reference(image, image.view(), 64, band);
}

TEST(Census, EqualsReferenceAtEveryStride) {
  for (int padding = 0; padding < 70; padding += 3) {
    const GrayPlane image = test::noise(37, 8, padding);
    const test::PaddedImage<std::uint8_t> padded(image, padding, padding % 7);
    expect_reference(image, padded.view(), 32, 3);
    EXPECT_TRUE(padded.unchanged());
  }
}

TEST(Census, HasABitForEachNeighborThatIsDarker) {
  // One dark pixel is in the window of 24 others, each of which has another bit for it.
  GrayPlane image(9, 9, 200);
  image(4, 4) = 199;
  const test::Plane<std::uint32_t> bits =
      bits_of(census_of(image.view(), CensusOrder::kForward, 0), 9);
  std::uint32_t seen = 0;
  for (int y = 0; y < 9; ++y) {
    for (int x = 0; x < 9; ++x) {
      const bool near = std::abs(x - 4) <= 2 && std::abs(y - 4) <= 2 && !(x == 4 && y == 4);
      EXPECT_EQ(near ? 1 : 0, std::popcount(bits(x, y))) << x << ", " << y;
      EXPECT_EQ(0u, seen & bits(x, y)) << x << ", " << y;
      seen |= bits(x, y);
    }
  }
  EXPECT_EQ((1u << kCensusBits) - 1, seen);
}

TEST(Census, OfAFlatImageIsNothing) {
  for (const int gray : {0, 1, 254, 255}) {
    const GrayPlane flat(33, 7, static_cast<std::uint8_t>(gray));
    const CensusImage census = census_of(flat.view(), CensusOrder::kMirrored, 32);
    EXPECT_TRUE(same_image(test::Plane<std::uint32_t>(65, 7), bits_of(census, 65)));
  }
}

TEST(Census, DoesNotChangeWithTheExposure) {
  Random random(2);
  for (int i = 0; i < 40; ++i) {
    const GrayPlane image = test::noise(random.between(1, 60), random.between(1, 12), i, 100);
    const GrayPlane other = test::exposed_otherwise(image, random);
    EXPECT_FALSE(image == other);
    EXPECT_TRUE(
        same_image(bits_of(census_of(image.view(), CensusOrder::kForward, 0), image.width),
                   bits_of(census_of(other.view(), CensusOrder::kForward, 0), image.width)));
  }
}

TEST(Census, ChangesWhereTheOrderOfGrayValuesDoes) {
  const GrayPlane image = test::noise(40, 9, 3, 100);
  GrayPlane inverted = image;
  for (std::uint8_t& gray : inverted.pixels) gray = static_cast<std::uint8_t>(255 - gray);
  EXPECT_FALSE(same_image(bits_of(census_of(image.view(), CensusOrder::kForward, 0), 40),
                          bits_of(census_of(inverted.view(), CensusOrder::kForward, 0), 40)));
}

}  // namespace
}  // namespace mtstereo
