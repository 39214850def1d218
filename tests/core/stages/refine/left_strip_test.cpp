// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/left_strip.hpp"

#include <gtest/gtest.h>

#include "reference/refine/left_strip.hpp"
#include "support/compare.hpp"
#include "support/random.hpp"

namespace mtstereo::left_strip_test {
namespace {

using reference::ConfidentMap;

ConfidentMap corrected(const ConfidentMap& in, int strip, int band = 1 << 20) {
  Image<std::int32_t> map = image_of(in.map);
  Image<std::uint8_t> confidence = image_of(in.confidence);
  for (int y = 0; y < map.height(); y += band) {
    correct_left_strip(strip, y, std::min(y + band, map.height()), map, confidence);
  }
  return {copy_of(map), copy_of(confidence)};
}

/// A row whose columns from 40 on are a believed surface of 60 px.
ConfidentMap row_with_strip(int disparity, int confidence) {
  ConfidentMap made{DisparityPlane(100, 1, 256 * 60), GrayPlane(100, 1, 200)};
  for (int x = 0; x < 40; ++x) {
    made.map(x, 0) = 256 * disparity;
    made.confidence(x, 0) = static_cast<std::uint8_t>(confidence);
  }
  return made;
}

TEST(LeftStrip, EqualsReferenceAtEveryWidthAndStrip) {
  test::Random random(1);
  for (int width = 1; width <= 60; ++width) {
    for (const int strip : {-5, 0, 1, width / 2, width - 1, width, width + 9}) {
      ConfidentMap in{DisparityPlane(width, 9), GrayPlane(width, 9)};
      for (std::size_t i = 0; i < in.map.pixels.size(); ++i) {
        in.map.pixels[i] = random.between(1, 256 * 70);
        in.confidence.pixels[i] = static_cast<std::uint8_t>(random.between(1, 160));
      }
      const ConfidentMap expected = reference::correct_left_strip(in, strip);
      for (const int band : {1, 4, 1 << 20}) {
        const ConfidentMap actual = corrected(in, strip, band);
        EXPECT_TRUE(same_image(expected.map, actual.map)) << width << ", strip of " << strip;
        EXPECT_TRUE(same_image(expected.confidence, actual.confidence)) << width;
      }
    }
  }
}

TEST(LeftStrip, ContinuesTheSurfaceWhereSomethingFarIsDoubted) {
  const ConfidentMap out = corrected(row_with_strip(5, 99), 64);
  for (int x = 0; x < 100; ++x) {
    EXPECT_EQ(256 * 60, out.map(x, 0)) << x;
    EXPECT_EQ(x < 40 ? 1 : 200, out.confidence(x, 0)) << x;
  }
}

TEST(LeftStrip, KeepsWhatIsBelievedOrNotMuchFarther) {
  for (const ConfidentMap& in :
       {row_with_strip(5, 100), row_with_strip(30, 20), row_with_strip(90, 1)}) {
    const ConfidentMap out = corrected(in, 64);
    EXPECT_TRUE(same_image(in.map, out.map));
    EXPECT_TRUE(same_image(in.confidence, out.confidence));
  }
}

TEST(LeftStrip, ChangesNothingOutsideOfTheStrip) {
  const ConfidentMap in = row_with_strip(5, 50);
  const ConfidentMap out = corrected(in, 10);
  for (int x = 10; x < 100; ++x) {
    EXPECT_EQ(in.map(x, 0), out.map(x, 0)) << x;
    EXPECT_EQ(in.confidence(x, 0), out.confidence(x, 0)) << x;
  }
}

TEST(LeftStrip, KeepsARowWithoutABelievedSurface) {
  ConfidentMap in = row_with_strip(5, 50);
  for (std::uint8_t& confidence : in.confidence.pixels) confidence = 99;
  EXPECT_TRUE(same_image(in.map, corrected(in, 64).map));
}

}  // namespace
}  // namespace mtstereo::left_strip_test
