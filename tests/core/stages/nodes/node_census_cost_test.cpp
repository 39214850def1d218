// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/nodes/node_census_cost.hpp"

#include <gtest/gtest.h>

#include "reference/nodes/pair_cost.hpp"
#include "support/random.hpp"
#include "support/simd_targets.hpp"

namespace mtstereo {
namespace {

using test::Random;

CensusImage image_of_words(const test::Plane<std::uint32_t>& words) {
  CensusImage image;
  image.resize(words.width, words.height);
  for (int y = 0; y < words.height; ++y) {
    std::copy_n(&words(0, y), words.width, image.bits.row(y));
  }
  return image;
}

test::Plane<std::uint32_t> random_words(int width, int height, Random& random) {
  test::Plane<std::uint32_t> words(width, height);
  for (std::uint32_t& word : words.pixels) {
    word = static_cast<std::uint32_t>(random.next());
  }
  return words;
}

/// The census of a random pair of views, in the formats of the library and of the reference.
struct RandomCensus {
  RandomCensus(int width, int height, Random& random)
      : plain{random_words(width, height, random), random_words(width, height, random)},
        left(image_of_words(plain.left)),
        right(image_of_words(plain.right)) {}

  float cost(int y, const NodePair& pair) const {
    return census_intensity_cost(left, right, y, pair);
  }
  float expected(int y, const NodePair& pair) const {
    return reference::census_intensity_cost<float>(plain, y, {pair.left_begin, pair.left_end, 0},
                                                   {pair.right_begin, pair.right_end, 0});
  }

  reference::CensusPair plain;
  CensusImage left, right;
};

/// Any node of the left view, and any node of the right view that is not to the right of it.
NodePair random_pair(int width, Random& random) {
  NodePair pair{};
  pair.left_begin = random.below(width);
  pair.left_end = random.between(pair.left_begin, width - 1);
  pair.right_begin = random.between(0, pair.left_begin);
  pair.right_end = random.between(pair.right_begin, pair.left_end);
  return pair;
}

TEST(NodeCensusCost, EqualsReferenceOnEveryInstructionSet) {
  test::for_each_simd_target([] {
    Random random(1);
    for (int width = 1; width <= 90; ++width) {
      const RandomCensus census(width, 2, random);
      for (int n = 0; n < 40; ++n) {
        const NodePair pair = random_pair(width, random);
        const int y = random.below(2);
        ASSERT_EQ(census.expected(y, pair), census.cost(y, pair))
            << "[" << pair.left_begin << ", " << pair.left_end << "] and [" << pair.right_begin
            << ", " << pair.right_end << "] of " << width << " px";
      }
    }
  });
}

TEST(NodeCensusCost, StaysInTheViewsForTheLongestAndSteepestNodes) {
  Random random(2);
  constexpr int kWidth = 16384;
  const RandomCensus census(kWidth, 1, random);
  for (const NodePair& pair :
       {NodePair{0, kWidth - 1, 0, kWidth - 1}, NodePair{1023, kWidth - 1, 0, kWidth - 1},
        NodePair{0, kWidth - 1, 0, kWidth - 1024}, NodePair{1023, kWidth - 1, 0, kWidth - 1024},
        NodePair{1023, 1024, 0, 1024}, NodePair{1023, 1023, 0, 0}}) {
    EXPECT_EQ(census.expected(0, pair), census.cost(0, pair));
  }
}

TEST(NodeCensusCost, IsZeroForEqualPixelsAndAllBitsForInvertedOnes) {
  test::Plane<std::uint32_t> words(40, 1, 0x123456u), opposite(40, 1, ~0x123456u & 0xFFFFFFu);
  const CensusImage left = image_of_words(words);
  const NodePair pair{20, 30, 12, 22};
  EXPECT_EQ(0, census_intensity_cost(left, left, 0, pair));
  EXPECT_EQ(kCensusBits * kBitCost, census_intensity_cost(left, image_of_words(opposite), 0, pair));
}

TEST(NodeCensusCost, IncludesColumnsBesideTheNode) {
  test::Plane<std::uint32_t> words(60, 1), other(60, 1);
  for (int x = 0; x < 60; ++x) {
    words(x, 0) = 0;
    other(x, 0) = x < 20 || x > 30 ? 0xFFFFFF : 0;
  }
  const NodePair pair{20, 30, 20, 30};
  const float cost = census_intensity_cost(image_of_words(words), image_of_words(other), 0, pair);
  // Columns 15, 17, 19 and 31, 33, 35 of 15 .. 35 differ in all bits.
  EXPECT_FLOAT_EQ(1.0F * kCensusBits * kBitCost * 6 / 11, cost);
}

}  // namespace
}  // namespace mtstereo
