// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/prepare/census.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <vector>

#include "reference/prepare/census.hpp"
#include "support/census.hpp"
#include "support/compare.hpp"
#include "support/padded_image.hpp"
#include "support/simd_targets.hpp"

namespace mtstereo::census_test {
namespace {

using test::census_of;

test::Plane<std::uint32_t> bits_of(const GrayPlane& image) {
  return test::copy_of(census_of(image.view()).bits);
}

/// Compares a view's transform with the reference, in bands.
void expect_reference(const GrayPlane& image, GrayView view, int band) {
  for (const int scales : {1, 2}) {
    EXPECT_TRUE(
        test::same_image(reference::census(image, scales), census_of(view, band, scales).bits))
        << scales << " scales, bands of " << band;
  }
}

TEST(Census, EqualsReferenceAtEverySizeOnEveryInstructionSet) {
  test::for_each_simd_target([] {
    for (int width = 1; width <= 140; ++width) {
      for (int height = 1; height <= 9; height += width < 20 ? 1 : 4) {
        const GrayPlane image = test::noise(width, height, 100 * width + height, 6);
        expect_reference(image, image.view(), 1 + (width + height) % 5);
      }
    }
  });
}

TEST(Census, EqualsReferenceOverAllGrayValues) {
  test::for_each_simd_target([] {
    const GrayPlane noise = test::noise(300, 20, 4);
    expect_reference(noise, noise.view(), 7);
    const GrayPlane extremes = test::black_and_white(300, 20, 5);
    expect_reference(extremes, extremes.view(), 7);
  });
}

TEST(Census, TransformsEveryNthRow) {
  const GrayPlane image = test::texture(45, 39, 1);
  for (const int scales : {1, 2}) {
    const test::Plane<std::uint32_t> all = reference::census(image, scales);
    for (const int step : {2, 4}) {
      for (const int band : {1, 3, 64}) {
        const CensusImage some = census_of(image.view(), band, scales, step);
        EXPECT_TRUE(test::same_pixels(
            45, (39 + step - 1) / step, [&](int x, int y) { return all(x, y * step); },
            [&](int x, int y) { return some.bits.row(y)[x]; }))
            << scales << " scales, step " << step << ", bands of " << band;
      }
    }
  }
}

TEST(Census, EqualsReferenceInEveryBand) {
  const GrayPlane image = test::texture(45, 40, 1);
  for (int band = 1; band <= 41; ++band) expect_reference(image, image.view(), band);
}

TEST(Census, EqualsReferenceAtEveryStride) {
  for (int padding = 0; padding < 70; padding += 3) {
    const GrayPlane image = test::noise(37, 8, padding);
    const test::PaddedImage<std::uint8_t> padded(image, padding, padding % 7);
    expect_reference(image, padded.view(), 3);
    EXPECT_TRUE(padded.unchanged());
  }
}

TEST(Census, HasABitForEachDarkerNeighbor) {
  // One dark pixel, too little for the smoothed view, is a neighbor of 16 other pixels; each of
  // them has another bit of the lower two bytes set.
  GrayPlane image(9, 9, 200);
  image(4, 4) = 199;
  const test::Plane<std::uint32_t> bits = bits_of(image);
  std::uint32_t seen = 0;
  for (int y = 0; y < 9; ++y) {
    for (int x = 0; x < 9; ++x) {
      const int columns = std::abs(x - 4), rows = std::abs(y - 4);
      const bool near = columns <= 1 && rows <= 1 && columns + rows > 0;
      const bool far = columns % 2 == 0 && rows % 2 == 0 && columns <= 2 && rows <= 2;
      EXPECT_EQ(near || (far && columns + rows > 0) ? 1 : 0, std::popcount(bits(x, y)))
          << x << ", " << y;
      EXPECT_EQ(0u, seen & bits(x, y)) << x << ", " << y;
      seen |= bits(x, y);
    }
  }
  EXPECT_EQ(0xFFFFu, seen);
}

TEST(Census, HasABitForEachPixelOfTheWindowInOneScale) {
  GrayPlane image(9, 9, 200);
  image(4, 4) = 199;
  const test::Plane<std::uint32_t> bits = test::copy_of(census_of(image.view(), 9, 1).bits);
  std::uint32_t seen = 0;
  for (int y = 0; y < 9; ++y) {
    for (int x = 0; x < 9; ++x) {
      const bool near = std::abs(x - 4) <= 2 && std::abs(y - 4) <= 2 && !(x == 4 && y == 4);
      EXPECT_EQ(near ? 1 : 0, std::popcount(bits(x, y))) << x << ", " << y;
      seen |= bits(x, y);
    }
  }
  EXPECT_EQ(0xFFFFFFu, seen);
}

TEST(Census, ComparesTheSmoothedViewOverLongerDistances) {
  // A vertical edge between columns 19 and 20. The smoothed view changes up to 2 px away from it,
  // so that neighbors at 4 px differ up to 6 px away. At the bright side they are darker in three
  // of the eight directions; at the dark side they are brighter, which sets no bit.
  GrayPlane image(40, 20, 200);
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 20; ++x) image(x, y) = 100;
  }
  const test::Plane<std::uint32_t> bits = bits_of(image);
  EXPECT_EQ(0u, bits(13, 10));
  EXPECT_EQ(0u, bits(16, 10));
  EXPECT_EQ(3, std::popcount(bits(22, 10) >> 16));
  EXPECT_EQ(3, std::popcount(bits(25, 10) >> 16));
  EXPECT_EQ(0u, bits(26, 10));
}

TEST(Census, IsZeroForAFlatImage) {
  for (const int gray : {0, 1, 254, 255}) {
    const GrayPlane flat(33, 7, static_cast<std::uint8_t>(gray));
    EXPECT_TRUE(same_image(test::Plane<std::uint32_t>(33, 7), bits_of(flat)));
  }
}

TEST(Census, DoesNotChangeWithTheBrightness) {
  Random random(2);
  for (int i = 0; i < 40; ++i) {
    const GrayPlane image = test::noise(random.between(1, 60), random.between(1, 12), i, 100);
    const GrayPlane other = test::brighter(image, random.between(1, 155));
    EXPECT_TRUE(same_image(bits_of(image), bits_of(other)));
  }
}

TEST(Census, ComparesTheViewItselfIndependentlyOfTheExposure) {
  Random random(2);
  for (int i = 0; i < 40; ++i) {
    const GrayPlane image = test::noise(random.between(1, 60), random.between(1, 12), i, 100);
    const GrayPlane other = test::exposed_otherwise(image, random);
    EXPECT_FALSE(image == other);
    test::Plane<std::uint32_t> bits = bits_of(image), other_bits = bits_of(other);
    for (std::uint32_t& word : bits.pixels) word &= 0xFFFF;
    for (std::uint32_t& word : other_bits.pixels) word &= 0xFFFF;
    EXPECT_TRUE(same_image(bits, other_bits));
  }
}

TEST(Census, ChangesWithTheOrderOfGrayValues) {
  const GrayPlane image = test::noise(40, 9, 3, 100);
  GrayPlane inverted = image;
  for (std::uint8_t& gray : inverted.pixels) gray = static_cast<std::uint8_t>(255 - gray);
  EXPECT_FALSE(same_image(bits_of(image), bits_of(inverted)));
}

std::vector<std::uint32_t> random_words(int count, Random& random) {
  std::vector<std::uint32_t> words;
  for (int i = 0; i < count; ++i) {
    words.push_back(static_cast<std::uint32_t>(random.next()));
  }
  return words;
}

/// Splits and mirrors the words, compares each plane, and checks that nothing is written after it.
void expect_mirrored(const std::vector<std::uint32_t>& words, int beyond) {
  const int width = static_cast<int>(words.size());
  constexpr std::uint8_t kUntouched = 0xA5;
  // The memory that the function may write, and one more byte.
  std::vector<std::vector<std::uint8_t>> planes(
      kCensusBytes, std::vector<std::uint8_t>(width + beyond + 1, kUntouched));
  std::uint8_t* const rows[] = {planes[0].data(), planes[1].data(), planes[2].data()};
  mirror_census_row(words.data(), width, beyond, rows);
  for (int i = 0; i < kCensusBytes; ++i) {
    std::vector<std::uint8_t> expected;
    for (const std::uint32_t word : words) {
      expected.push_back(static_cast<std::uint8_t>(word >> 8 * i));
    }
    std::reverse(expected.begin(), expected.end());
    expected.resize(width + beyond, expected.back());
    expected.push_back(kUntouched);
    EXPECT_EQ(expected, planes[i])
        << "plane " << i << ", width " << width << ", " << beyond << " beyond";
  }
}

TEST(MirrorCensusRow, MirrorsAtEveryWidthOnEveryInstructionSet) {
  test::for_each_simd_target([] {
    for (int width = 1; width <= 200; ++width) {
      Random random(width);
      const std::vector<std::uint32_t> words = random_words(width, random);
      for (const int beyond : {0, 1, 32, 97}) {
        expect_mirrored(words, beyond);
      }
    }
  });
}

}  // namespace
}  // namespace mtstereo::census_test
