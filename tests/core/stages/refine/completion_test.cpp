// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/completion.hpp"

#include <gtest/gtest.h>

#include "reference/refine/completion.hpp"
#include "support/compare.hpp"
#include "support/random_maps.hpp"

namespace mtstereo::completion_test {
namespace {

using reference::ConfidentMap;

/// A map with a random confidence at each of its known pixels.
ConfidentMap confident(const DisparityPlane& map) {
  test::Random random(1);
  ConfidentMap made{map, GrayPlane(map.width, map.height)};
  for (std::size_t i = 0; i < map.pixels.size(); ++i) {
    if (map.pixels[i] != 0) {
      made.confidence.pixels[i] = static_cast<std::uint8_t>(random.between(1, 255));
    }
  }
  return made;
}

ConfidentMap completed(const ConfidentMap& in, int band) {
  Image<std::int32_t> map = image_of(in.map);
  Image<std::uint8_t> confidence = image_of(in.confidence);
  for (int y = 0; y < map.height(); y += band) {
    complete_rows(y, std::min(y + band, map.height()), map, confidence);
  }
  complete_empty_rows(map, confidence);
  return {copy_of(map), copy_of(confidence)};
}

void expect_reference(const DisparityPlane& map) {
  const ConfidentMap in = confident(map);
  const ConfidentMap expected = reference::complete(in);
  for (const int band : {1, 7, 1 << 20}) {
    const ConfidentMap actual = completed(in, band);
    EXPECT_TRUE(same_image(expected.map, actual.map)) << "bands of " << band << " rows";
    EXPECT_TRUE(same_image(expected.confidence, actual.confidence)) << band;
  }
}

TEST(Completion, EqualsReferenceAtEveryWidth) {
  for (int width = 1; width <= 70; ++width) {
    for (int of_ten = 0; of_ten <= 10; of_ten += 2) {
      expect_reference(test::patches(width, 1 + width % 37, of_ten, 10 * width + of_ten));
    }
  }
}

TEST(Completion, EqualsReferenceWithEmptyRows) {
  test::Random random(2);
  for (int height = 1; height <= 60; ++height) {
    DisparityPlane map = test::disparity_noise(5, height, 5, 5000, height);
    for (int y = 0; y < height; ++y) {
      if (random.below(4) == 0) continue;
      for (int x = 0; x < 5; ++x) map(x, y) = 0;
    }
    expect_reference(map);
  }
}

TEST(Completion, FillsGapsWithTheBackground) {
  DisparityPlane map(7, 1);
  map(2, 0) = 900;
  map(5, 0) = 300;
  const ConfidentMap out = completed(confident(map), 1);
  EXPECT_EQ(out.map.pixels, (std::vector<std::int32_t>{900, 900, 900, 300, 300, 300, 300}));
}

TEST(Completion, SetsAnEmptyMapToInfinity) {
  const ConfidentMap out = completed(confident(DisparityPlane(4, 3)), 2);
  EXPECT_EQ(out.map, DisparityPlane(4, 3, 1));
  EXPECT_EQ(out.confidence, GrayPlane(4, 3, 1));
}

TEST(Completion, SeparatesInferredFromMatchedByConfidence) {
  const ConfidentMap in = confident(test::patches(90, 40, 3, 1));
  const ConfidentMap out = completed(in, 40);
  for (std::size_t i = 0; i < in.map.pixels.size(); ++i) {
    EXPECT_EQ(in.map.pixels[i] != 0, out.confidence.pixels[i] > kMostInferred);
    EXPECT_GE(out.confidence.pixels[i], 1);
    EXPECT_GE(out.map.pixels[i], 1);
  }
}

}  // namespace
}  // namespace mtstereo::completion_test
