// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <cstdlib>
#include <string_view>

#include "support/compare.hpp"
#include "support/matching.hpp"
#include "support/padded_image.hpp"
#include "support/random.hpp"
#include "support/watching.hpp"

namespace mtstereo::invariants_test {
namespace {

using test::Pair;

constexpr const char* kPresetNames[] = {"default", "fast", "paper"};
constexpr const char* kModes[] = {"sparse", "semi-dense", "dense"};

/// Whether a result has disparities that were inferred, also where the right view shows nothing.
bool is_inferred(std::string_view mode) { return mode == "dense"; }

/// Fails if a disparity reaches max-disparity or, unless it may be inferred, points beyond the left
/// border.
void expect_possible(const DisparityPlane& map, int max_disparity, bool inferred = false) {
  EXPECT_TRUE(test::same_pixels(
      map.width, map.height, [](int, int) { return true; },
      [&](int x, int y) {
        const int d = map(x, y);
        return d == kNoDisparity || (d >= 1 && (inferred || d <= x * kDisparityOne) &&
                                     d < max_disparity * kDisparityOne);
      }))
      << "max-disparity " << max_disparity;
}

/// The same for the map after each step, in px of the matched resolution.
void expect_all_possible(const Parameters& parameters, const Pair& pair) {
  const Settings settings(parameters);
  bool complete = false;
  for (const auto& [step, map] : test::maps_after_steps(parameters, pair.left, pair.right)) {
    SCOPED_TRACE(step);
    complete = complete || step == "completion";
    const bool matched = map.width != pair.left.width || !settings.half();
    expect_possible(map, matched ? settings.disparities : settings.view_disparities, complete);
  }
}

/// Fraction of the disparities that are within one px of `disparity`.
double share_near(const DisparityPlane& map, double disparity) {
  long near = 0;
  for (const std::int32_t d : map.pixels) {
    if (d != kNoDisparity && std::abs(d / 256.0 - disparity) <= 1) ++near;
  }
  return static_cast<double>(near) / static_cast<double>(std::max(test::known(map), 1L));
}

// Feature: sparse and dense modes
TEST(Invariants, AShiftedPairHasItsShiftAsDisparityInAllModes) {
  for (const char* const mode : kModes) {
    for (const int shift : {3, 17, 40}) {
      for (const char* const volume : {"half", "full"}) {
        SCOPED_TRACE(testing::Message() << mode << ", " << shift << " px, " << volume);
        const Pair pair = test::shifted_pair(320, 120, shift, shift);
        Matcher matcher = test::matcher({{"mode", mode}, {"cost-volume", volume}});
        const auto [map, confidence, statistics] = test::match(matcher, pair.left, pair.right);
        EXPECT_GT(statistics.density, std::string(mode) == "sparse" ? 0.03 : 0.15);
        EXPECT_GT(share_near(map, shift), 0.98);
        expect_possible(map, 64, is_inferred(mode));
      }
    }
  }
}

// Feature: reduced resolution for speed
TEST(Invariants, AShiftedPairHasItsShiftAsDisparityAtHalfResolution) {
  for (const char* const mode : kModes) {
    for (const int shift : {4, 17, 40}) {
      SCOPED_TRACE(testing::Message() << mode << ", " << shift << " px");
      const Pair pair = test::shifted_pair(321, 121, shift, shift);
      Matcher matcher = test::matcher({{"preset", "fast"}, {"mode", mode}});
      const auto [map, confidence, statistics] = test::match(matcher, pair.left, pair.right);
      EXPECT_GT(statistics.density, std::string(mode) == "sparse" ? 0.005 : 0.15);
      // An odd shift is not an integer at half resolution.
      const double least = is_inferred(mode) ? 0.97 : 0.98;
      EXPECT_GT(share_near(map, shift), shift % 2 == 0 ? least : 0.9);
      expect_possible(map, 64, is_inferred(mode));
    }
  }
}

TEST(Invariants, AnIdenticalPairHasDisparityZero) {
  const GrayPlane image = test::texture(200, 80, 1);
  for (const char* const mode : kModes) {
    Matcher matcher = test::matcher({{"mode", mode}});
    const DisparityPlane map = test::compute(matcher, image, image);
    EXPECT_GT(test::known(map), 200) << mode;
    EXPECT_GT(share_near(map, 0), 0.98) << mode;
  }
}

TEST(Invariants, SwappedViewsHaveFewDisparities) {
  for (const char* const mode : kModes) {
    const Pair pair = test::shifted_pair(320, 120, 17, 2);
    Matcher matcher = test::matcher({{"mode", mode}});
    const long right = test::known(test::compute(matcher, pair.left, pair.right));
    const DisparityPlane swapped = test::compute(matcher, pair.right, pair.left);
    EXPECT_LT(test::known(swapped), right / 4) << mode;
    expect_possible(swapped, 64, is_inferred(mode));
  }
}

TEST(Invariants, UnrelatedViewsHaveFewDisparities) {
  for (const char* const mode : kModes) {
    Matcher matcher = test::matcher({{"mode", mode}});
    const auto [map, confidence, statistics] =
        test::match(matcher, test::texture(320, 120, 3), test::texture(320, 120, 4));
    EXPECT_LT(statistics.density, 0.1) << mode;
    expect_possible(map, 64, is_inferred(mode));
  }
}

TEST(Invariants, FlatImagesHaveNoDisparities) {
  const GrayPlane textured = test::texture(120, 40, 5);
  for (const char* const mode : kModes) {
    Matcher matcher = test::matcher({{"mode", mode}});
    for (const int gray : {0, 1, 128, 255}) {
      const GrayPlane flat(120, 40, static_cast<std::uint8_t>(gray));
      EXPECT_EQ(0, test::known(test::compute(matcher, flat, flat))) << mode << ", gray " << gray;
      EXPECT_EQ(0, test::known(test::compute(matcher, flat, textured)))
          << mode << ", gray " << gray;
      EXPECT_EQ(0, test::known(test::compute(matcher, textured, flat)))
          << mode << ", gray " << gray;
    }
  }
}

// Feature: any search range, also negative
TEST(Invariants, EveryStepIsInRangeForExtremeSearchRanges) {
  for (const char* const mode : kModes) {
    for (const auto& [width, disparities] : {std::pair{1, 1},
                                             {2, 2},
                                             {100, 1},
                                             {100, 2},
                                             {100, 3},
                                             {100, 100},
                                             {1023, 1023},
                                             {1100, 1023},
                                             {2000, 1984},
                                             {1984, 1984}}) {
      SCOPED_TRACE(testing::Message() << mode << ", " << width << " px");
      const Pair pair = test::slanted_pair(width, 12, std::max(disparities / 2, 1), 6);
      expect_all_possible(
          test::parameters({{"mode", mode}, {"max-disparity", std::to_string(disparities)}}), pair);
    }
  }
}

TEST(Invariants, TheResultIsInRangeAtHalfResolution) {
  for (const char* const mode : kModes) {
    for (const auto& [width, disparities] : {std::pair{1, 1},
                                             {2, 1},
                                             {2, 2},
                                             {3, 3},
                                             {101, 1},
                                             {100, 2},
                                             {101, 3},
                                             {101, 101},
                                             {100, 99},
                                             {1100, 1023},
                                             {1985, 1984}}) {
      SCOPED_TRACE(testing::Message() << mode << ", " << width << " px, " << disparities);
      const Pair pair = test::slanted_pair(width, 13, std::max(disparities / 2, 1), 6);
      expect_all_possible(test::parameters({{"preset", "fast"},
                                            {"mode", mode},
                                            {"min-confidence", "0"},
                                            {"max-disparity", std::to_string(disparities)}}),
                          pair);
    }
  }
}

TEST(Invariants, NoiseAtFullContrastIsInRange) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    expect_all_possible(
        test::parameters({{"max-disparity", "90"},
                          {"node-confidence", "0"},
                          {"pixel-confidence", "0"},
                          {"outlier-radius", "0"}}),
        {test::black_and_white(90, 60, seed), test::black_and_white(90, 60, seed + 50)});
  }
}

TEST(Invariants, TheInputIsNotWrittenTo) {
  const Pair pair = test::slanted_pair(150, 70, 20, 7);
  for (const int padding : {0, 1, 42, 64}) {
    const test::PaddedImage<std::uint8_t> left(pair.left, padding, 5), right(pair.right, padding);
    Matcher matcher = test::matcher({});
    ASSERT_TRUE(matcher.compute(left.view(), right.view()).ok());
    EXPECT_TRUE(left.unchanged() && right.unchanged()) << "padding of " << padding << " bytes";
  }
}

TEST(Invariants, EverySmallSizeCanBeMatched) {
  Matcher matcher = test::matcher({{"max-disparity", "1"}});
  for (int width = 1; width <= 12; ++width) {
    for (int height = 1; height <= 12; ++height) {
      const Pair pair = {test::noise(width, height, width),
                         test::noise(width, height, height + 99)};
      Parameters parameters = matcher.parameters();
      for (const char* const resolution : {"full", "half", "half-refined"}) {
        test::set_all(parameters,
                      {{"max-disparity", std::to_string(width)}, {"resolution", resolution}});
        ASSERT_TRUE(matcher.set_parameters(parameters).ok());
        const DisparityPlane map = test::compute(matcher, pair.left, pair.right);
        EXPECT_EQ(width, map.width);
        EXPECT_EQ(height, map.height);
        expect_possible(map, width);
      }
    }
  }
}

TEST(Invariants, AnImageOfOnePixelHasNoDisparity) {
  Matcher matcher = test::matcher({{"max-disparity", "1"}});
  for (const char* const mode : kModes) {
    Parameters parameters = matcher.parameters();
    test::set_all(parameters, {{"mode", mode}});
    ASSERT_TRUE(matcher.set_parameters(parameters).ok());
    EXPECT_EQ(DisparityPlane(1, 1, kNoDisparity),
              test::compute(matcher, GrayPlane(1, 1, 7), GrayPlane(1, 1, 200)));
  }
}

// Feature: any search range, also negative
TEST(Invariants, AWideImageHasItsLargeDisparities) {
  for (const char* const preset : kPresetNames) {
    for (const int shift : {900, 1960}) {
      SCOPED_TRACE(testing::Message() << preset << ", " << shift << " px");
      const Pair pair = test::shifted_pair(4096, 24, shift, 8);
      Matcher matcher = test::matcher(
          {{"preset", preset}, {"max-disparity", std::to_string(kLargestMaxDisparity)}});
      const auto [map, confidence, statistics] = test::match(matcher, pair.left, pair.right);
      expect_possible(map, kLargestMaxDisparity);
      EXPECT_GT(statistics.density, 0.02);
      EXPECT_GT(share_near(map, shift), 0.95);
    }
  }
}

TEST(Invariants, DisparitiesDoNotDependOnDistantRows) {
  // The image is cut after kRows rows. Rows farther away from the cut than kReach, the reach of
  // neighbors, smoothing and votes, must not change. The noise, the sharpness and the sizes of
  // areas are those of the whole view.
  const Pair whole = test::slanted_pair(160, 200, 24, 9);
  constexpr int kRows = 140, kReach = 5 + 2 * 21 + 2 * 10 * 2 + 4;
  const auto top = [](const GrayPlane& image) {
    GrayPlane cut(image.width, kRows);
    std::copy_n(image.pixels.begin(), cut.pixels.size(), cut.pixels.begin());
    return cut;
  };
  Matcher matcher =
      test::matcher({{"noise-filter", "false"}, {"speckle-size", "0"}, {"min-confidence", "0"}});
  const DisparityPlane expected = test::compute(matcher, whole.left, whole.right);
  const DisparityPlane map = test::compute(matcher, top(whole.left), top(whole.right));
  EXPECT_TRUE(test::same_pixels(
      160, kRows - kReach, [&](int x, int y) { return expected(x, y); },
      [&](int x, int y) { return map(x, y); }));
}

TEST(Invariants, ExactlyKnownPixelsHaveAConfidence) {
  const Pair pair = test::slanted_pair(200, 90, 30, 10);
  for (const char* const preset : kPresetNames) {
    for (const char* const mode : kModes) {
      SCOPED_TRACE(testing::Message() << preset << ", " << mode);
      Matcher matcher = test::matcher({{"preset", preset}, {"mode", mode}});
      const auto result = test::match(matcher, pair.left, pair.right);
      const auto& map = result.map;
      EXPECT_GT(test::known(map), 10);
      EXPECT_TRUE(test::same_pixels(
          map.width, map.height, [&](int x, int y) { return map(x, y) != kNoDisparity; },
          [&](int x, int y) { return result.confidence(x, y) != 0; }));
    }
  }
}

TEST(Invariants, ModeSemiDenseHasNoInferredPixels) {
  const Pair pair = test::slanted_pair(200, 90, 30, 11);
  for (const char* const least : {"0", "5"}) {
    Matcher matcher = test::matcher({{"min-confidence", least}, {"max-gap", "0"}});
    const auto [map, confidence, statistics] = test::match(matcher, pair.left, pair.right);
    EXPECT_GT(test::known(map), 1000);
    EXPECT_LT(test::known(map), 200 * 90);
    for (const std::uint8_t value : confidence.pixels) {
      ASSERT_TRUE(value == 0 || value > kMostInferred);
    }
  }
}

TEST(Invariants, ModeSemiDenseClosesGapsWithInferredPixels) {
  const Pair pair = test::slanted_pair(200, 90, 30, 11);
  Matcher open = test::matcher({{"max-gap", "0"}});
  Matcher closed = test::matcher({{"max-gap", "5"}});
  const test::Matched before = test::match(open, pair.left, pair.right);
  const test::Matched after = test::match(closed, pair.left, pair.right);
  EXPECT_GT(test::known(after.map), test::known(before.map));
  for (std::size_t i = 0; i < after.map.pixels.size(); ++i) {
    if (before.map.pixels[i] == kNoDisparity) {
      ASSERT_LE(after.confidence.pixels[i], kMostInferred);
    } else {
      ASSERT_EQ(before.map.pixels[i], after.map.pixels[i]);
      ASSERT_EQ(before.confidence.pixels[i], after.confidence.pixels[i]);
    }
  }
}

// Feature: left-right check, uniqueness, confidence threshold
TEST(Invariants, NoDisparityHasLessThanTheMinimumConfidence) {
  const Pair pair = test::slanted_pair(200, 90, 30, 11);
  Matcher matcher = test::matcher({{"min-confidence", "0"}, {"max-gap", "0"}});
  long before = test::known(test::compute(matcher, pair.left, pair.right));
  for (const int least : {120, 160, 200}) {
    Parameters parameters = matcher.parameters();
    test::set_all(parameters, {{"min-confidence", std::to_string(least)}});
    ASSERT_TRUE(matcher.set_parameters(parameters).ok());
    const auto [map, confidence, statistics] = test::match(matcher, pair.left, pair.right);
    for (const std::uint8_t value : confidence.pixels) ASSERT_TRUE(value == 0 || value >= least);
    EXPECT_LT(test::known(map), before) << "at least " << least;
    before = test::known(map);
  }
  EXPECT_GT(before, 0);
}

}  // namespace
}  // namespace mtstereo::invariants_test
