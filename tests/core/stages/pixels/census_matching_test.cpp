// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixels/census_matching.hpp"

#include <gtest/gtest.h>

#include "reference/pixels/pixel_matching.hpp"
#include "support/census.hpp"
#include "support/compare.hpp"
#include "support/matching.hpp"

namespace mtstereo {
namespace {

using reference::RatedMap;
using test::copy_of;
using test::DisparityPlane;
using test::GrayPlane;
using test::Pair;
using test::Random;

/// The disparities and peak ratios of a pair, computed in bands of `band` rows from the last band
/// to the first.
RatedMap matched(const Pair& pair, const CensusMatchingOptions& options,
                 const DisparityPlane& nodes, int band, CensusMatchingScratch& scratch) {
  const test::CensusPair census(pair.left.view(), pair.right.view());
  Image<std::int32_t> map = image_of(nodes);
  Image<std::uint8_t> ratio;
  ratio.resize(nodes.width, nodes.height);
  test::poison(ratio);
  scratch.resize(nodes.width, options);
  for (int i = (nodes.height + band - 1) / band - 1; i >= 0; --i) {
    match_pixels_by_census(pair.left.view(), census.left, census.right, options, i * band,
                           std::min((i + 1) * band, nodes.height), scratch, map, ratio);
  }
  RatedMap out(nodes.width, nodes.height);
  out.map = copy_of(map);
  out.ratio = copy_of(ratio);
  return out;
}

/// Random nodes on a part of the map, with disparities near `around`.
DisparityPlane random_nodes(int width, int height, int disparities, int around, Random& random) {
  DisparityPlane nodes(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width;) {
      const bool known = random.below(3) == 0;
      const int disparity =
          std::clamp(256 * around + random.between(-900, 900), 1, 256 * disparities - 1);
      for (int n = random.between(1, 7); n > 0 && x < width; --n) nodes(x++, y) = known * disparity;
    }
  }
  return nodes;
}

CensusMatchingOptions random_options(int disparities, Random& random) {
  return {{0.15, static_cast<BetweenNodes>(random.below(3)), disparities},
          {disparities, 2 * random.below(3) + 1, random.below(33)},
          {random.below(51), random.below(51)},
          {disparities, 0.06 * random.below(3), random.below(2) == 0, random.between(-1, 2),
           random.below(2) == 0, random.below(50)}};
}

TEST(CensusMatching, EqualsReferenceAtEveryWidthAndInBands) {
  long known = 0;
  CensusMatchingScratch scratch;
  for (int width = 1; width <= 70; ++width) {
    Random random(width);
    const int height = random.between(1, 9);
    const int disparities = random.between(1, width);
    const int shift = random.below(disparities);
    const Pair pair = test::shifted_pair(width, height, shift, width);
    const DisparityPlane nodes = random_nodes(width, height, disparities, shift, random);
    const CensusMatchingOptions options = random_options(disparities, random);
    const RatedMap expected =
        reference::match_pixels_by_census(pair.left, pair.right, options, nodes);
    for (const int band : {1, 2, 5, 1 << 20}) {
      const RatedMap actual = matched(pair, options, nodes, band, scratch);
      EXPECT_TRUE(same_image(expected.map, actual.map)) << "bands of " << band << " rows";
      EXPECT_TRUE(same_image(expected.ratio, actual.ratio)) << "bands of " << band << " rows";
    }
    known += test::known(expected.map);
  }
  EXPECT_GT(known, 3000) << "too few results to compare";
}

TEST(CensusMatching, HasARatioExactlyAtPixelsWithADisparity) {
  Random random(1);
  CensusMatchingScratch scratch;
  const Pair pair = test::slanted_pair(90, 30, 20, 1);
  const RatedMap out =
      matched(pair, random_options(40, random), random_nodes(90, 30, 40, 10, random), 7, scratch);
  EXPECT_TRUE(test::same_pixels(
      90, 30, [&](int x, int y) { return out.map(x, y) != 0; },
      [&](int x, int y) { return out.ratio(x, y) != 0; }));
}

TEST(CensusMatching, DoesNotDependOnTheBrightnessOfEitherView) {
  Random random(2);
  CensusMatchingScratch scratch;
  for (int seed = 0; seed < 10; ++seed) {
    Pair pair = test::shifted_pair(80, 20, 9, seed);
    for (GrayPlane* view : {&pair.left, &pair.right}) {
      for (std::uint8_t& gray : view->pixels) gray = static_cast<std::uint8_t>(gray * 100 / 255);
    }
    const DisparityPlane nodes = random_nodes(80, 20, 30, 9, random);
    const CensusMatchingOptions options = random_options(30, random);
    const RatedMap expected = matched(pair, options, nodes, 20, scratch);
    const Pair other = {test::brighter(pair.left, 40), test::brighter(pair.right, 150)};
    EXPECT_TRUE(same_image(expected.map, matched(other, options, nodes, 20, scratch).map));
    EXPECT_TRUE(same_image(expected.ratio, matched(other, options, nodes, 20, scratch).ratio));
  }
}

TEST(CensusMatching, FindsADisparityOutsideTheExpectedRange) {
  const Pair pair = test::shifted_pair(120, 20, 30, 3);
  CensusMatchingScratch scratch;
  CensusMatchingOptions options = {
      {0.15, BetweenNodes::kAll, 50}, {50, 5, 2}, {4, 30}, {50, 0.06, false, 1, true, 0}};
  const DisparityPlane wrong(120, 20, 256 * 10);
  const auto share_right = [&] {
    const RatedMap out = matched(pair, options, wrong, 20, scratch);
    long right = 0;
    for (const std::int32_t d : out.map.pixels) right += std::abs(d - 256 * 30) <= 128;
    return static_cast<double>(right) / (90 * 20);
  };
  EXPECT_GT(share_right(), 0.9);
  options.cost.range_penalty = 24;
  EXPECT_LT(share_right(), 0.2) << "the range penalty must prevent it";
}

}  // namespace
}  // namespace mtstereo
