// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/disparity_refinement.hpp"

#include <gtest/gtest.h>

#include "reference/refine/disparity_refinement.hpp"
#include "support/census.hpp"
#include "support/compare.hpp"
#include "support/random_maps.hpp"
#include "support/simd_targets.hpp"

namespace mtstereo::disparity_refinement_test {
namespace {

using test::Pair;

constexpr int kWhole = 1 << 20;
constexpr int kFar = 1024;

/// Units of the map in a pixel of the full views.
constexpr int kPixel = 128;

/// The refined map of the halved views of a pair, computed in bands of `band` rows from the last
/// band to the first, in poisoned memory.
DisparityPlane refined(const Pair& pair, const DisparityPlane& map, int max_disparity = kFar,
                       int band = kWhole) {
  const test::CensusPair census(pair.left.view(), pair.right.view(), 2, 2);
  const Image<std::int32_t> from = image_of(map);
  Image<std::int32_t> out = image_of(DisparityPlane(map.width, map.height, 1 << 30));
  RefinementScratch scratch;
  scratch.resize(map.width);
  for (int i = (map.height - 1) / band; i >= 0; --i) {
    refine_disparities(census.left, census.right, from, max_disparity, i * band,
                       std::min((i + 1) * band, map.height), scratch, out);
  }
  return copy_of(out);
}

/// Limits each disparity to its column, as in every map of a matcher.
DisparityPlane possible(DisparityPlane map) {
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) map(x, y) = std::min(map(x, y), 256 * x);
  }
  return map;
}

void expect_reference(const Pair& pair, const DisparityPlane& map, int max_disparity = kFar) {
  const DisparityPlane expected = reference::refine(
      reference::census(pair.left), reference::census(pair.right), map, max_disparity);
  for (const int band : {1, 7, 64, kWhole}) {
    EXPECT_TRUE(same_image(expected, refined(pair, map, max_disparity, band)))
        << "bands of " << band << " rows";
  }
}

TEST(DisparityRefinement, EqualsReferenceAtEveryWidth) {
  for (int width = 1; width <= 160; ++width) {
    const int height = 1 + width * 7 % 46;
    const Pair pair = test::slanted_pair(width, height, std::max(width / 3, 1), width);
    const auto half = [](int size) { return (size + 1) / 2; };
    expect_reference(pair, possible(test::patches(half(width), half(height), width % 4, width)));
  }
}

TEST(DisparityRefinement, EqualsReferenceOnNoiseOfEveryDensity) {
  for (int of_ten = 0; of_ten <= 10; ++of_ten) {
    const Pair pair = {test::noise(180, 60, of_ten), test::noise(180, 60, 50 + of_ten)};
    for (const int largest : {300, 2000, test::kLargestDisparity}) {
      expect_reference(pair,
                       possible(test::disparity_noise(90, 30, of_ten, largest, of_ten + largest)),
                       of_ten % 2 == 0 ? kFar : 9);
    }
  }
}

TEST(DisparityRefinement, EqualsReferenceOnEveryInstructionSet) {
  const Pair pair = test::slanted_pair(245, 62, 30, 5);
  const DisparityPlane map = possible(test::patches(123, 31, 1, 6));
  test::for_each_simd_target([&] { expect_reference(pair, map); });
}

/// A slanted surface with holes, some of them wider than a vector.
DisparityPlane surface(int width, int height, int disparity, int slant, Random& random) {
  DisparityPlane map(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) map(x, y) = std::max(disparity + slant * x - 9 * y, 1);
    for (int hole = 0; hole < 3; ++hole) {
      const int begin = random.below(width);
      const int end = std::min(begin + random.below(40), width);
      for (int x = begin; x < end; ++x) map(x, y) = 0;
    }
  }
  return possible(map);
}

TEST(DisparityRefinement, EqualsReferenceForEverySlantOnEveryInstructionSet) {
  const Pair pair = test::slanted_pair(262, 45, 30, 7);
  test::for_each_simd_target([&] {
    Random random(8);
    // Up to 256, where all points of a row correspond to one right pixel.
    for (const int slant : {-200, -40, -7, 0, 7, 16, 40, 120, 256}) {
      SCOPED_TRACE("slant " + std::to_string(slant));
      // At infinity, near, and so near that all points correspond to the first right column.
      for (const int disparity : {0, 5000, test::kLargestDisparity}) {
        expect_reference(pair, surface(131, 23, disparity, slant, random));
      }
    }
  });
}

/// Fraction of the known pixels from column `first` on that are within `most` px of a disparity, of
/// the full views.
double share_within(const DisparityPlane& map, int first, double disparity, double most) {
  long near = 0, known = 0;
  for (int y = 0; y < map.height; ++y) {
    for (int x = first; x < map.width; ++x) {
      if (map(x, y) == 0) continue;
      ++known;
      near += std::abs(map(x, y) / double{kPixel} - disparity) <= most;
    }
  }
  return static_cast<double>(near) / static_cast<double>(std::max(known, 1L));
}

TEST(DisparityRefinement, CorrectsErrorsOfUpToOnePixel) {
  constexpr int kShift = 12;
  const Pair pair = test::shifted_pair(320, 120, kShift, 1);
  for (const int off : {-128, -90, -45, 0, 35, 95, 128}) {
    DisparityPlane map(160, 60);
    for (int y = 0; y < 60; ++y) {
      for (int x = 20; x < 160; ++x) map(x, y) = kPixel * kShift + off;
    }
    // The penalty keeps at most a quarter of the error.
    const double most = 0.08 + std::abs(off) / (4.0 * kPixel);
    EXPECT_GT(share_within(refined(pair, map), 24, kShift, most), 0.95) << "off by " << off;
  }
}

TEST(DisparityRefinement, ChangesLargeErrorsByAtMostTwoPixels) {
  const Pair pair = test::shifted_pair(320, 120, 12, 2);
  DisparityPlane map(160, 60);
  for (int y = 0; y < 60; ++y) {
    for (int x = 40; x < 160; ++x) map(x, y) = kPixel * 30;
  }
  EXPECT_EQ(1, share_within(refined(pair, map), 0, 30, 2));
}

TEST(DisparityRefinement, KeepsTheDisparitiesOfFlatViews) {
  const GrayPlane flat(120, 60, 90);
  const DisparityPlane map = possible(test::disparity_noise(60, 30, 3, 5000, 3));
  DisparityPlane whole = map;
  for (std::int32_t& d : whole.pixels) d = d / kPixel * kPixel;
  // Without texture only the penalty is left, which keeps the given disparity.
  EXPECT_TRUE(same_image(whole, refined({flat, flat}, whole)));
}

TEST(DisparityRefinement, KeepsTheSetOfKnownPixels) {
  const Pair pair = test::slanted_pair(200, 80, 20, 4);
  const DisparityPlane map = possible(test::disparity_noise(100, 40, 6, 5000, 4));
  const DisparityPlane out = refined(pair, map);
  EXPECT_TRUE(test::same_pixels(
      100, 40, [&](int x, int y) { return map(x, y) != 0; },
      [&](int x, int y) { return out(x, y) != 0; }));
}

TEST(DisparityRefinement, NeverExceedsTheColumnOrTheLargestDisparity) {
  for (int seed = 0; seed < 10; ++seed) {
    const Pair pair = {test::noise(140, 40, seed), test::noise(140, 40, 30 + seed)};
    DisparityPlane map(70, 20);
    Random random(seed);
    for (int y = 0; y < 20; ++y) {
      for (int x = 1; x < 70; ++x)
        map(x, y) = std::min(256 * x, kPixel * 33 - 1) - random.below(100);
    }
    const DisparityPlane out = refined(pair, map, 33);
    for (int y = 0; y < 20; ++y) {
      for (int x = 1; x < 70; ++x) {
        ASSERT_GE(out(x, y), 1);
        ASSERT_LE(out(x, y), 256 * x);
        ASSERT_LT(out(x, y), kPixel * 33);
      }
    }
  }
}

TEST(DisparityRefinement, DoesNotChangeWithTheBrightness) {
  Random random(7);
  Pair pair = test::slanted_pair(240, 80, 20, 7);
  for (GrayPlane* view : {&pair.left, &pair.right}) {
    for (std::uint8_t& gray : view->pixels) gray = static_cast<std::uint8_t>(gray * 100 / 255);
  }
  const Pair other = {pair.left, test::brighter(pair.right, random.between(1, 155))};
  const DisparityPlane map = possible(test::patches(120, 40, 1, 8));
  EXPECT_TRUE(same_image(refined(pair, map), refined(other, map)));
}

}  // namespace
}  // namespace mtstereo::disparity_refinement_test
