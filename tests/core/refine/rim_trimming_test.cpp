// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/rim_trimming.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "reference/refine/rim_trimming.hpp"
#include "support/compare.hpp"
#include "support/random_maps.hpp"

namespace mtstereo {
namespace {

using test::copy_of;
using test::disparity_noise;
using test::DisparityPlane;
using test::patches;

constexpr int kMost = std::numeric_limits<int>::max();
constexpr int kWhole = 1 << 20;

/// The map without its rim, in bands of `band` rows that are taken from the last to the first.
DisparityPlane trimmed(const DisparityPlane& map, int rim, int band, RimScratch& scratch,
                       Image<std::uint8_t>& marks) {
  Image<std::int32_t> image = image_of(map);
  marks.resize(map.width, map.height);
  scratch.resize(map.width, rim);
  const int bands = (map.height + band - 1) / band;
  for (int i = bands - 1; i >= 0; --i) {
    mark_rim(image, rim, i * band, std::min((i + 1) * band, map.height), scratch, marks);
  }
  for (int i = bands - 1; i >= 0; --i) {
    trim_rim(marks, rim, i * band, std::min((i + 1) * band, map.height), scratch, image);
  }
  return copy_of(image);
}

DisparityPlane trimmed(const DisparityPlane& map, int rim, int band = kWhole) {
  RimScratch scratch;
  Image<std::uint8_t> marks;
  return trimmed(map, rim, band, scratch, marks);
}

void expect_reference(const DisparityPlane& map, int rim) {
  const DisparityPlane expected = reference::trim_rim(map, rim);
  for (const int band : {1, 5, 32, kWhole}) {
    EXPECT_TRUE(same_image(expected, trimmed(map, rim, band)))
        << "rim of " << rim << ", bands of " << band << " rows";
  }
}

TEST(RimTrimming, EqualsReferenceAtEveryWidth) {
  for (int width = 1; width <= 70; ++width) {
    for (const int rim : {1, 2, 5}) {
      expect_reference(patches(width, 1 + width % 37, width % 5, 10 * width + rim), rim);
    }
  }
}

TEST(RimTrimming, EqualsReferenceInNarrowMaps) {
  for (int length = 1; length <= 60; ++length) {
    for (int side = 1; side <= 4; ++side) {
      expect_reference(patches(length, side, 2, length), 1 + length % 3);
      expect_reference(patches(side, length, 2, length), 1 + length % 3);
    }
  }
}

TEST(RimTrimming, EqualsReferenceForEveryRim) {
  for (int rim = 0; rim <= 40; ++rim) {
    // Mostly known, so that with a wide rim something is left.
    DisparityPlane map(61, 67, 1000);
    for (int y = 20; y < 24; ++y) {
      for (int x = 30; x < 35; ++x) map(x, y) = 0;
    }
    expect_reference(map, rim);
    expect_reference(patches(47, 40, 0, 100 + rim), rim);
  }
}

TEST(RimTrimming, EqualsReferenceOnNoiseOfEveryDensity) {
  for (int of_ten = 0; of_ten <= 10; ++of_ten) {
    for (int rim = 1; rim <= 4; ++rim) {
      expect_reference(disparity_noise(52, 45, of_ten, test::kLargestDisparity, 200 + rim), rim);
    }
  }
}

TEST(RimTrimming, EqualsReferenceForRimsAsLargeAsTheMapAndLarger) {
  DisparityPlane map(23, 17, 1000);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) map(x, y) = 0;
  }
  for (int rim = 12; rim <= 26; ++rim) expect_reference(map, rim);
  EXPECT_TRUE(same_image(DisparityPlane(23, 17), trimmed(map, kMost, 32)));
  EXPECT_TRUE(same_image(DisparityPlane(23, 17, 1), trimmed(DisparityPlane(23, 17, 1), kMost)));
}

TEST(RimTrimming, RemovesAsManyColumnsAndRowsAsTheRimHas) {
  for (int rim = 1; rim <= 6; ++rim) {
    DisparityPlane map(60, 50);
    DisparityPlane expected(60, 50);
    for (int y = 15; y < 40; ++y) {
      for (int x = 10; x < 50; ++x) {
        map(x, y) = 2000;
        if (x >= 10 + rim && x < 50 - rim && y >= 15 + rim && y < 40 - rim) expected(x, y) = 2000;
      }
    }
    EXPECT_TRUE(same_image(expected, trimmed(map, rim, 32)));
  }
}

TEST(RimTrimming, KeepsWhatIsAroundASmallHole) {
  for (int side = 1; side <= 3; ++side) {
    DisparityPlane map(30, 40, 3000);
    for (int y = 31; y < 31 + side; ++y) {
      for (int x = 12; x < 12 + side; ++x) map(x, y) = 0;
    }
    const DisparityPlane kept = trimmed(map, 2, 32);
    EXPECT_EQ(side < 3, kept == map) << "a hole of " << side << " px";
  }
}

TEST(RimTrimming, KeepsWhatIsAtTheBorder) {
  const DisparityPlane map(31, 45, 256);
  for (const int rim : {1, 5, 100}) EXPECT_TRUE(same_image(map, trimmed(map, rim, 32)));
}

TEST(RimTrimming, LeavesAnUnknownMapAndEveryMapWithoutARim) {
  EXPECT_TRUE(same_image(DisparityPlane(31, 45), trimmed(DisparityPlane(31, 45), 3, 32)));
  const DisparityPlane map = patches(31, 45, 3, 300);
  for (const int rim : {0, -1, std::numeric_limits<int>::min()}) {
    EXPECT_TRUE(same_image(map, trimmed(map, rim, 32)));
  }
}

TEST(RimTrimming, OnlyRemovesAndMoreWithAWiderRim) {
  for (int seed = 0; seed < 40; ++seed) {
    DisparityPlane before = patches(70, 60, seed % 3, 400 + seed);
    for (int rim = 1; rim <= 5; ++rim) {
      const DisparityPlane after = trimmed(patches(70, 60, seed % 3, 400 + seed), rim, 32);
      EXPECT_TRUE(only_removes(before, after));
      before = after;
    }
  }
}

TEST(RimTrimming, WorksInMemoryThatHeldOtherMaps) {
  RimScratch scratch;
  Image<std::uint8_t> marks;
  for (int seed = 0; seed < 30; ++seed) {
    const DisparityPlane map = patches(10 + 31 * seed % 60, 5 + 17 * seed % 70, 0, 500 + seed);
    EXPECT_TRUE(same_image(reference::trim_rim(map, 1 + seed % 4),
                           trimmed(map, 1 + seed % 4, 32, scratch, marks)));
  }
}

TEST(RimTrimming, HandlesTheLargestWidthAndHeight) {
  for (const bool wide : {true, false}) {
    DisparityPlane map(wide ? 16384 : 5, wide ? 5 : 16384, 500);
    for (std::size_t i = map.pixels.size() / 2; i < map.pixels.size() / 2 + 60; ++i) {
      map.pixels[i] = 0;
    }
    for (int x = 0; wide && x < 16384; ++x) {
      if (x % 1000 < 9) {
        for (int y = 0; y < 5; ++y) map(x, y) = 0;
      }
    }
    for (int i = 0; i < 5 * 70; ++i) map.pixels[i] = 0;
    expect_reference(map, 2);
  }
}

}  // namespace
}  // namespace mtstereo
