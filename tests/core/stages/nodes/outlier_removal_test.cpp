// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/nodes/outlier_removal.hpp"

#include <gtest/gtest.h>

#include "reference/nodes/outlier_removal.hpp"
#include "support/compare.hpp"
#include "support/random.hpp"
#include "support/simd_targets.hpp"

namespace mtstereo::outlier_removal_test {
namespace {

/// Removes the outliers of a whole map in bands of `band` rows.
DisparityPlane filtered(const DisparityPlane& map, int radius, int band = 1 << 20) {
  Image<std::int32_t> image = image_of(map);
  VoteMap votes;
  votes.resize(map.width, map.height, radius);
  for (int y = 0; y < map.height; y += band) {
    copy_votes(image, y, std::min(y + band, map.height), votes);
  }
  const int columns = votes.integral.width();
  const int block = std::min(band, columns);
  for (int x = 0; x < columns; x += block) sum_votes(x, std::min(x + block, columns), votes);
  for (int y = 0; y < map.height; y += band) {
    remove_outliers(votes, y, std::min(y + band, map.height), image);
  }
  return copy_of(image);
}

/// A map in which `of_ten` of ten pixels have a disparity, mostly near a plane, sometimes anywhere.
DisparityPlane random_map(int width, int height, int of_ten, std::uint64_t seed) {
  Random random(seed);
  DisparityPlane map(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (random.below(10) >= of_ten) continue;
      map(x, y) = random.below(3) == 0 ? random.between(1, 1024 * 256 - 1)
                                       : 20 * 256 + 64 * (x % 3000) + random.between(0, 6 * 256);
    }
  }
  return map;
}

void expect_reference(const DisparityPlane& map, int radius) {
  const DisparityPlane expected = reference::remove_outliers(map, radius);
  test::for_each_simd_target(
      [&] { EXPECT_TRUE(same_image(expected, filtered(map, radius))) << "radius " << radius; });
}

TEST(OutlierRemoval, EqualsReferenceAtEveryWidth) {
  for (int width = 1; width <= 70; ++width) {
    for (const int radius : {1, 4, 21}) {
      expect_reference(random_map(width, 1 + width % 23, 1 + width % 10, width), radius);
    }
  }
}

TEST(OutlierRemoval, EqualsReferenceForEveryRadius) {
  for (int radius = 0; radius <= 31; ++radius) {
    expect_reference(random_map(75, 41, 6, 100 + radius), radius);
  }
}

TEST(OutlierRemoval, EqualsReferenceOnDenseAndOnEmptyMaps) {
  for (const int of_ten : {0, 1, 10}) {
    for (const int radius : {2, 21, 31}) expect_reference(random_map(80, 70, of_ten, 200), radius);
  }
}

TEST(OutlierRemoval, EqualsReferenceOnWideRows) {
  expect_reference(random_map(8192, 2, 5, 300), 21);
}

TEST(OutlierRemoval, EqualsReferenceAtExtremeDisparities) {
  Random random(400);
  DisparityPlane map(60, 60);
  for (std::int32_t& d : map.pixels) {
    constexpr std::int32_t kExtremes[] = {0, 1, 2, 1024 * 256 - 1, 1024 * 256 - 5, 1023 * 256};
    d = kExtremes[random.below(6)];
  }
  for (const int radius : {1, 21, 31}) expect_reference(map, radius);
}

TEST(OutlierRemoval, DoesNotDependOnBands) {
  const DisparityPlane map = random_map(90, 70, 6, 500);
  for (const int band : {1, 7, 32, 69}) {
    EXPECT_TRUE(same_image(reference::remove_outliers(map, 21), filtered(map, 21, band)));
  }
}

TEST(OutlierRemoval, KeepsAnIsolatedDisparity) {
  DisparityPlane map(50, 50);
  map(25, 25) = 30 * 256;
  EXPECT_TRUE(same_image(map, filtered(map, 21)));
}

TEST(OutlierRemoval, KeepsASlantedPlane) {
  // A slope of 1 px of disparity per column is the largest that a supporting pixel allows.
  DisparityPlane map(120, 40);
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 120; ++x) map(x, y) = 256 * (1 + x);
  }
  EXPECT_TRUE(same_image(map, filtered(map, 21)));
}

TEST(OutlierRemoval, RemovesDisparitiesThatTheirSurroundingsContradict) {
  DisparityPlane map(60, 60, 10 * 256);
  map(30, 30) = 200 * 256;
  const DisparityPlane kept = filtered(map, 21);
  EXPECT_EQ(0, kept(30, 30));
  EXPECT_EQ(1, std::count(kept.pixels.begin(), kept.pixels.end(), 0));
}

TEST(OutlierRemoval, KeepsTiesAndRemovesAMajority) {
  DisparityPlane map(20, 20);
  map(10, 10) = 50 * 256;
  map(10, 11) = 90 * 256;  // one supporter (the pixel itself), one contradiction
  EXPECT_EQ(50 * 256, filtered(map, 5)(10, 10));
  map(10, 9) = 90 * 256;
  EXPECT_EQ(0, filtered(map, 5)(10, 10));
}

TEST(OutlierRemoval, WithRadiusZeroRemovesNothing) {
  const DisparityPlane map = random_map(40, 40, 5, 600);
  EXPECT_TRUE(same_image(map, filtered(map, 0)));
}

}  // namespace
}  // namespace mtstereo::outlier_removal_test
