// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixels/texture.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "reference/pixels/pixel_matching.hpp"
#include "support/random.hpp"
#include "support/simd_targets.hpp"

namespace mtstereo {
namespace {

using test::Plane;
using test::Random;

/// Few bits, so that there are flat pixels.
Plane<std::uint32_t> sparse_words(int width, int height, int one_of, Random& random) {
  Plane<std::uint32_t> words(width, height);
  for (std::uint32_t& word : words.pixels) {
    if (random.below(one_of) == 0) word = std::uint32_t{1} << random.below(32);
  }
  return words;
}

/// Returns the number of flat pixels.
int expect_reference(const Plane<std::uint32_t>& words) {
  const int width = words.width;
  CensusImage census;
  census.bits = test::image_of(words);
  TextureScratch scratch;
  scratch.resize(width);
  int flat = 0;
  for (int y = 0; y < words.height; ++y) {
    Buffer<std::uint16_t> low, high;
    low.resize(width);
    high.resize(width);
    for (int x = 0; x < width; ++x) {
      low[x] = static_cast<std::uint16_t>(x);
      high[x] = static_cast<std::uint16_t>(2 * x);
    }
    exclude_flat(census, y, scratch, low.data(), high.data());
    for (int x = 0; x < width; ++x) {
      const bool excluded = reference::is_flat(words, x, y);
      flat += excluded;
      EXPECT_EQ(excluded ? 1 : x, low[x]) << x << ", " << y << " of " << width;
      EXPECT_EQ(excluded ? 0 : 2 * x, high[x]) << x << ", " << y << " of " << width;
    }
  }
  return flat;
}

TEST(Texture, EqualsReferenceAtEveryWidthOnEveryInstructionSet) {
  test::for_each_simd_target([] {
    int flat = 0;
    for (int width = 1; width <= 90; ++width) {
      Random random(width);
      flat += expect_reference(sparse_words(width, 1 + width % 9, 25, random));
    }
    EXPECT_GT(flat, 1000) << "too few results to compare";
  });
}

TEST(Texture, ExcludesEverythingInAFlatView) {
  EXPECT_EQ(40 * 9, expect_reference(Plane<std::uint32_t>(40, 9)));
}

TEST(Texture, ExcludesNothingNearTexture) {
  EXPECT_EQ(0, expect_reference(Plane<std::uint32_t>(40, 9, std::uint32_t{1} << 31)));
  Plane<std::uint32_t> one(40, 9);
  one(20, 4) = 1;
  EXPECT_EQ(40 * 9 - 25, expect_reference(one));
}

}  // namespace
}  // namespace mtstereo
