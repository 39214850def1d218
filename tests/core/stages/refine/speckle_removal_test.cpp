// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/speckle_removal.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <utility>

#include "reference/refine/speckle_removal.hpp"
#include "support/compare.hpp"
#include "support/random_maps.hpp"
#include "support/simd_targets.hpp"

namespace mtstereo::speckle_removal_test {
namespace {

using test::disparity_noise;
using test::patches;

constexpr int kWhole = 1 << 20;

/// The map without its speckles and the weights of its areas, computed in bands of `band` rows from
/// the last band to the first.
reference::Areas filtered_areas(const DisparityPlane& map, int tolerance, int size, int band,
                                SpeckleRuns& runs) {
  Image<std::int32_t> image = image_of(map);
  runs.resize(map.width, map.height);
  Image<std::uint8_t> area;
  area.resize(map.width, map.height);
  const int bands = (map.height + band - 1) / band;
  for (int i = bands - 1; i >= 0; --i) {
    find_runs(image, tolerance, i * band, std::min((i + 1) * band, map.height), runs);
  }
  join_bands(image, tolerance, band, runs);
  for (int i = bands - 1; i >= 0; --i) {
    remove_small(runs, size, i * band, std::min((i + 1) * band, map.height), image, &area);
  }
  return {copy_of(image), copy_of(area)};
}

DisparityPlane filtered(const DisparityPlane& map, int tolerance, int size, int band = kWhole) {
  SpeckleRuns runs;
  return filtered_areas(map, tolerance, size, band, runs).map;
}

void expect_reference(const DisparityPlane& map, int tolerance, int size) {
  const reference::Areas expected = reference::remove_speckles(map, tolerance, size);
  SpeckleRuns runs;
  for (const int band : {1, 3, 32, kWhole}) {
    const reference::Areas actual = filtered_areas(map, tolerance, size, band, runs);
    EXPECT_TRUE(same_image(expected.map, actual.map))
        << "tolerance " << tolerance << ", size " << size << ", bands of " << band << " rows";
    EXPECT_TRUE(same_image(expected.weight, actual.weight))
        << "tolerance " << tolerance << ", size " << size << ", bands of " << band << " rows";
  }
}

TEST(SpeckleRemoval, EqualsReferenceAtEveryWidth) {
  for (int width = 1; width <= 70; ++width) {
    for (int of_ten = 0; of_ten < 6; ++of_ten) {
      expect_reference(patches(width, 1 + width % 37, of_ten, 10 * width + of_ten), 64,
                       1 + width % 30);
    }
  }
}

TEST(SpeckleRemoval, EqualsReferenceInRowsOfEveryWidthOnEveryInstructionSet) {
  test::for_each_simd_target([] {
    for (int width = 1; width <= 200; ++width) {
      expect_reference(disparity_noise(width, 3, width % 4, 700, width), 256, 1 + width % 9);
      // Long runs, which continue from one word of columns to the next.
      expect_reference(patches(width, 3, 0, 500 + width), 1 << 20, width + 1);
    }
  });
}

TEST(SpeckleRemoval, FindsTheRunsOfARow) {
  constexpr int kWidth = 150;
  DisparityPlane map(kWidth, 1);
  // A run that ends with the first 64 columns, one that begins with the next 64, one after a step,
  // and one in the last column.
  for (int x = 3; x < 64; ++x) map(x, 0) = 1000;
  for (int x = 64; x < 130; ++x) map(x, 0) = 3000;
  for (int x = 130; x < 140; ++x) map(x, 0) = 3257;
  map(kWidth - 1, 0) = 1;
  test::for_each_simd_target([&] {
    SpeckleRuns runs;
    runs.resize(kWidth, 1);
    find_runs(image_of(map), 256, 0, 1, runs);
    ASSERT_EQ(0u, runs.first[0]);
    ASSERT_EQ(4u, runs.last[0]);
    constexpr int kBegin[] = {3, 64, 130, kWidth - 1};
    constexpr int kEnd[] = {64, 130, 140, kWidth};
    for (int i = 0; i < 4; ++i) {
      EXPECT_EQ(kBegin[i], runs.begin[i]);
      EXPECT_EQ(kEnd[i], runs.end[i]);
      EXPECT_EQ(kRootRun + static_cast<std::uint32_t>(kEnd[i] - kBegin[i]), runs.link[i]);
    }
  });
}

TEST(SpeckleRemoval, EqualsReferenceInOneRowAndInOneColumn) {
  for (int length = 1; length <= 100; ++length) {
    expect_reference(disparity_noise(length, 1, 2, 600, length), 256, 4);
    expect_reference(disparity_noise(1, length, 2, 600, length), 256, 4);
  }
}

TEST(SpeckleRemoval, EqualsReferenceForEverySize) {
  const DisparityPlane map = patches(61, 67, 1, 100);
  for (int size = 0; size <= 80; ++size) expect_reference(map, 128, size);
}

TEST(SpeckleRemoval, EqualsReferenceForEveryTolerance) {
  const DisparityPlane map = disparity_noise(53, 70, 1, 900, 200);
  for (int tolerance = 0; tolerance <= 900; tolerance += 30) expect_reference(map, tolerance, 12);
}

TEST(SpeckleRemoval, EqualsReferenceOnNoiseOfEveryDensity) {
  // Includes the density at which components of noise begin to span the map.
  for (int of_ten = 0; of_ten <= 10; ++of_ten) {
    for (int seed = 0; seed < 10; ++seed) {
      expect_reference(disparity_noise(64, 65, of_ten, 2, 300 + seed), seed % 2, 20 + 40 * seed);
    }
  }
}

TEST(SpeckleRemoval, EqualsReferenceAtExtremes) {
  constexpr int kMost = std::numeric_limits<std::int32_t>::max();
  test::Random random(400);
  DisparityPlane map(45, 45);
  for (std::int32_t& d : map.pixels) {
    constexpr std::int32_t kExtremes[] = {0, 1, 2, test::kLargestDisparity, kMost - 1, kMost};
    d = kExtremes[random.below(6)];
  }
  for (const int tolerance : {0, 1, test::kLargestDisparity, kMost - 2, kMost}) {
    for (const int size : {0, 1, 3, 45 * 45, kMost}) expect_reference(map, tolerance, size);
  }
}

TEST(SpeckleRemoval, EqualsReferenceOnACheckerboard) {
  // One run per pixel, and half as many.
  DisparityPlane full(64, 64, 512);
  DisparityPlane half(64, 64);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      if ((x + y) % 2 == 0) full(x, y) = half(x, y) = 9999;
    }
  }
  for (const int size : {0, 1, 2, 64 * 64}) {
    expect_reference(full, 100, size);
    expect_reference(half, 100, size);
  }
}

/// A line one pixel wide that runs from the center to the border as a square spiral.
DisparityPlane spiral(int side) {
  DisparityPlane map(side, side);
  int x = side / 2;
  int y = side / 2;
  int dx = 1;
  int dy = 0;
  for (int leg = 2;; leg += 2) {
    for (int turn = 0; turn < 2; ++turn) {
      for (int step = 0; step < leg; ++step) {
        if (x < 0 || x >= side || y < 0 || y >= side) return map;
        map(x, y) = 2560;
        x += dx;
        y += dy;
      }
      dx = -std::exchange(dy, dx);
    }
  }
}

TEST(SpeckleRemoval, FollowsAComponentAcrossManyBands) {
  const DisparityPlane map = spiral(131);
  const int pixels = static_cast<int>(map.pixels.size()) -
                     static_cast<int>(std::count(map.pixels.begin(), map.pixels.end(), 0));
  for (const int band : {1, 2, 32, kWhole}) {
    EXPECT_TRUE(same_image(map, filtered(map, 0, pixels, band)));
    EXPECT_TRUE(same_image(DisparityPlane(131, 131), filtered(map, 0, pixels + 1, band)));
  }
}

TEST(SpeckleRemoval, FollowsAComb) {
  // The teeth are separate runs in all rows but the last; comb from the left and from the right.
  for (const bool mirrored : {false, true}) {
    DisparityPlane map(99, 70);
    for (int y = 0; y < 70; ++y) {
      for (int x = 0; x < 99; ++x) {
        const int column = mirrored ? 98 - x : x;
        if (y == 69 || (column % 2 == 0 && y >= column / 2)) map(x, y) = 777;
      }
    }
    const int pixels = static_cast<int>(std::count(map.pixels.begin(), map.pixels.end(), 777));
    EXPECT_TRUE(same_image(map, filtered(map, 0, pixels, 32)));
    EXPECT_TRUE(same_image(DisparityPlane(99, 70), filtered(map, 0, pixels + 1, 32)));
  }
}

// Feature: speckle filter, median, filling of gaps
TEST(SpeckleRemoval, RemovesComponentsSmallerThanTheSizeOnly) {
  DisparityPlane map(20, 70);
  for (int y = 30; y < 35; ++y) map(7, y) = 1000;
  EXPECT_TRUE(same_image(map, filtered(map, 10, 5, 32)));
  EXPECT_TRUE(same_image(DisparityPlane(20, 70), filtered(map, 10, 6, 32)));
}

TEST(SpeckleRemoval, ConnectsPixelsUpToTheTolerance) {
  DisparityPlane map(2, 2);
  map(0, 0) = 500;
  map(1, 0) = 564;
  map(1, 1) = 500;
  EXPECT_TRUE(same_image(map, filtered(map, 64, 3)));
  EXPECT_TRUE(same_image(DisparityPlane(2, 2), filtered(map, 63, 3)));
}

TEST(SpeckleRemoval, DoesNotConnectDiagonalNeighbors) {
  DisparityPlane map(2, 2);
  map(0, 0) = map(1, 1) = 500;
  EXPECT_TRUE(same_image(DisparityPlane(2, 2), filtered(map, 1000, 2)));
}

TEST(SpeckleRemoval, DoesNotConnectTheEndOfARowToTheStartOfTheNext) {
  DisparityPlane map(5, 2);
  map(4, 0) = map(0, 1) = 500;
  EXPECT_TRUE(same_image(DisparityPlane(5, 2), filtered(map, 1000, 2)));
}

TEST(SpeckleRemoval, RemovesNothingFromAnUnknownMapOrWithSizesUpToOne) {
  EXPECT_TRUE(same_image(DisparityPlane(33, 40), filtered(DisparityPlane(33, 40), 64, 100)));
  const DisparityPlane map = disparity_noise(33, 40, 8, 5000, 500);
  for (const int size : {std::numeric_limits<int>::min(), -1, 0, 1}) {
    EXPECT_TRUE(same_image(map, filtered(map, 0, size, 32)));
  }
}

TEST(SpeckleRemoval, KeepsACompletelyKnownMapUpToItsSize) {
  const DisparityPlane map(40, 67, 300);
  EXPECT_TRUE(same_image(map, filtered(map, 0, 40 * 67, 32)));
  EXPECT_TRUE(same_image(DisparityPlane(40, 67), filtered(map, 0, 40 * 67 + 1, 32)));
}

TEST(SpeckleRemoval, OnlyRemovesDisparitiesAndNothingTheSecondTime) {
  for (int seed = 0; seed < 40; ++seed) {
    const DisparityPlane map = patches(50, 70, 1 + seed % 4, 600 + seed);
    const DisparityPlane once = filtered(map, 40, 10 + seed, 32);
    EXPECT_TRUE(only_removes(map, once));
    EXPECT_TRUE(same_image(once, filtered(once, 40, 10 + seed, 32)));
    // Components that a larger size keeps are also kept by a smaller one.
    EXPECT_TRUE(only_removes(once, filtered(map, 40, 20 + seed, 32)));
  }
}

TEST(SpeckleRemoval, CanReuseTheMemoryOfOtherMaps) {
  SpeckleRuns runs;
  for (int seed = 0; seed < 30; ++seed) {
    const DisparityPlane map = patches(10 + 31 * seed % 60, 5 + 17 * seed % 70, 2, 700 + seed);
    EXPECT_TRUE(same_image(reference::remove_speckles(map, 64, 15).map,
                           filtered_areas(map, 64, 15, 32, runs).map));
  }
}

TEST(SpeckleRemoval, HandlesTheLargestWidth) {
  DisparityPlane map(16384, 3, 4000);
  for (int x = 0; x < 16384; x += 2) map(x, 1) = x % 4 == 0 ? 0 : 9000;
  map(16383, 0) = 8000;
  expect_reference(map, 100, 2);
  expect_reference(map, 100, 16385);
}

TEST(SpeckleRemoval, WeighsAreasByTheirShareOfTheMap) {
  // The map has 3000 px, so 300 px have full weight, and each halving costs 7 %.
  constexpr std::pair<int, int> kWeights[] = {{1, 144},   {30, 202},  {150, 237},
                                              {299, 254}, {300, 255}, {3000, 255}};
  for (const auto& [pixels, weight] : kWeights) {
    DisparityPlane map(100, 30);
    for (int i = 0; i < pixels; ++i) map.pixels[i] = 1000;
    SpeckleRuns runs;
    const reference::Areas areas = filtered_areas(map, 10, 0, 7, runs);
    EXPECT_EQ(weight, areas.weight(0, 0)) << pixels << " px";
    EXPECT_EQ(pixels == 3000 ? 255 : 0, areas.weight(99, 29));
  }
}

}  // namespace
}  // namespace mtstereo::speckle_removal_test
