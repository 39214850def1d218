// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/clues.hpp"

#include <gtest/gtest.h>

#include "reference/refine/reliability.hpp"
#include "support/random_ratings.hpp"
#include "support/simd_targets.hpp"

namespace mtstereo::clues_test {
namespace {

using test::RandomRating;

/// Sums of one row of the map, each found on its own.
void expect_rows(const RandomRating& rated, const ClueMaps& clues) {
  const int width = rated.in.map.width;
  const reference::RatedPair pair = rated.pair(1);
  for (int y = 0; y < rated.in.map.height; ++y) {
    for (int x = 0; x < width; ++x) {
      int matched = 0;
      for (int i = std::max(x - kShareReach, 0); i <= std::min(x + kShareReach, width - 1); ++i) {
        matched += rated.in.confidence(i, y) > kMostInferred;
      }
      ASSERT_EQ(matched, clues.matched.row(y)[x]);
      const reference::PixelClues pixel(pair, rated.in, x, y);
      ASSERT_EQ(pixel.mismatch(0), clues.mismatch.row(y)[x]) << x << ", " << y;
      ASSERT_EQ(pixel.texture(0), clues.texture.row(y)[x]) << x << ", " << y;
      ASSERT_EQ(rated.in.map(x, y) / 16, clues.disparity.row(y)[kClueBorder + x]);
    }
    for (int i = 1; i <= kClueBorder; ++i) {
      const std::int16_t* row = clues.disparity.row(y);
      ASSERT_EQ(row[kClueBorder], row[kClueBorder - i]);
      ASSERT_EQ(row[kClueBorder + width - 1], row[kClueBorder + width - 1 + i]);
    }
  }
}

TEST(Clues, EqualReferenceAtEveryWidthOnEveryInstructionSet) {
  test::for_each_simd_target([] {
    for (int width = 1; width <= 90; ++width) {
      const RandomRating rated(width, 1 + width % 5, width);
      ClueMaps clues;
      clues.resize(width, rated.in.map.height);
      ClueScratch scratch;
      scratch.resize(rated.right.width);
      const Image<std::int32_t> map = image_of(rated.in.map);
      const Image<std::uint8_t> confidence = image_of(rated.in.confidence);
      gather_clues(rated.views(1), map, confidence, 0, map.height(), scratch, clues);
      expect_rows(rated, clues);
    }
  });
}

}  // namespace
}  // namespace mtstereo::clues_test
