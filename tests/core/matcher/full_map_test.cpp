// SPDX-License-Identifier: LGPL-2.1-or-later
// Mode full: every pixel has a disparity, and its confidence states whether it was matched.
#include <gtest/gtest.h>

#include <cstdlib>

#include "support/matching.hpp"
#include "support/random.hpp"

namespace mtstereo::full_map_test {
namespace {

using test::Pair;

constexpr const char* kPresetNames[] = {"default", "fast"};

/// Matches a pair in mode full. Expects a disparity and a confidence in every pixel.
test::Matched full_map(Matcher& matcher, const Pair& pair) {
  test::Matched matched = test::match(matcher, pair.left, pair.right);
  const auto& [map, confidence, statistics] = matched;
  EXPECT_EQ(test::known(map), static_cast<long>(map.pixels.size()));
  EXPECT_EQ(std::count(confidence.pixels.begin(), confidence.pixels.end(), 0), 0);
  EXPECT_EQ(statistics.density, 1);
  return matched;
}

TEST(FullMap, HasADisparityInEveryPixelAtEverySize) {
  for (const char* const preset : kPresetNames) {
    for (int width = 1; width <= 40; ++width) {
      for (const char* const least : {"0", "-3", "2"}) {
        const int height = 1 + width % 7;
        SCOPED_TRACE(testing::Message() << preset << ", " << width << " px, from " << least);
        if (std::atoi(least) >= width / 2) continue;
        Matcher matcher = test::matcher({{"preset", preset},
                                         {"mode", "full"},
                                         {"max-disparity", std::to_string((width + 1) / 2 + 1)},
                                         {"min-disparity", least},
                                         {"min-node-width", "0"}});
        if (width > 2) full_map(matcher, test::slanted_pair(width, height, width / 3, width));
      }
    }
  }
}

TEST(FullMap, HasTheShiftOfAShiftedPairWhereBothViewsShowIt) {
  for (const char* const preset : kPresetNames) {
    for (const int shift : {4, 18, 40}) {
      SCOPED_TRACE(testing::Message() << preset << ", " << shift << " px");
      Matcher matcher = test::matcher({{"preset", preset}, {"mode", "full"}});
      const DisparityPlane map = full_map(matcher, test::shifted_pair(320, 121, shift, shift)).map;
      long near = 0;
      for (int y = 0; y < 121; ++y) {
        for (int x = shift; x < 320; ++x) near += std::abs(map(x, y) - 256 * shift) <= 128;
      }
      EXPECT_GT(near, (320 - shift) * 121 * 98 / 100);
    }
  }
}

TEST(FullMap, RatesWhatTheRightViewDoesNotShowAsInferred) {
  constexpr int kShift = 30;
  for (const char* const preset : kPresetNames) {
    SCOPED_TRACE(preset);
    Matcher matcher = test::matcher({{"preset", preset}, {"mode", "full"}});
    const GrayPlane confidence =
        full_map(matcher, test::shifted_pair(320, 121, kShift, 1)).confidence;
    long matched = 0;
    for (int y = 0; y < 121; ++y) {
      for (int x = 0; x < kShift - 4; ++x) EXPECT_LE(confidence(x, y), kMostInferred);
      for (int x = kShift; x < 320; ++x) matched += confidence(x, y) > kMostInferred;
    }
    EXPECT_GT(matched, 290 * 121 * 97 / 100);
  }
}

TEST(FullMap, IsFarWhereBothViewsAreFlat) {
  for (const char* const preset : kPresetNames) {
    Matcher matcher = test::matcher({{"preset", preset}, {"mode", "full"}});
    const GrayPlane flat(150, 60, 128);
    const DisparityPlane map = full_map(matcher, {flat, flat}).map;
    EXPECT_LE(*std::max_element(map.pixels.begin(), map.pixels.end()), kDisparityOne) << preset;
  }
}

TEST(FullMap, FillsWhatTheConfidenceRemoves) {
  const Pair pair = test::slanted_pair(200, 90, 40, 1);
  Matcher all = test::matcher({{"mode", "full"}});
  Matcher sure = test::matcher({{"mode", "full"}, {"min-confidence", "180"}});
  const GrayPlane of_all = full_map(all, pair).confidence;
  const GrayPlane of_sure = full_map(sure, pair).confidence;
  const auto inferred = [](const GrayPlane& confidence) {
    return std::count_if(confidence.pixels.begin(), confidence.pixels.end(),
                         [](int c) { return c <= kMostInferred; });
  };
  EXPECT_LT(inferred(of_all), inferred(of_sure));
}

}  // namespace
}  // namespace mtstereo::full_map_test
