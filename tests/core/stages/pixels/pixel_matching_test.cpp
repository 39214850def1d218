// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixels/pixel_matching.hpp"

#include <gtest/gtest.h>

#include "reference/pixels/pixel_matching.hpp"
#include "support/compare.hpp"
#include "support/stages.hpp"

namespace mtstereo::pixel_matching_test {
namespace {

using test::RandomVolume;

/// The options of the paper's method; range and confidence are fractions.
PixelMatchingOptions paper(double range, double confidence, bool subpixel) {
  return {{range, 0}, {0, confidence, true, -1, subpixel, 0}};
}

/// The options with the number of disparities of the volume.
PixelMatchingOptions fitting(const CostVolume& volume, PixelMatchingOptions options) {
  options.range.disparities = options.selection.disparities = volume.disparities;
  return options;
}

/// Disparities and peak ratios, in bands of three rows.
reference::RatedMap rated(const CostVolume& volume, const PixelMatchingOptions& options,
                          const DisparityPlane& map) {
  Image<std::int32_t> image = image_of(map);
  Image<std::uint8_t> ratio;
  ratio.resize(map.width, map.height);
  test::poison(ratio);
  PixelMatchingScratch scratch;
  scratch.resize(map.width);
  for (int y = 0; y < map.height; y += 3) {
    match_pixels(volume, fitting(volume, options), y, std::min(y + 3, map.height), scratch, image,
                 ratio);
  }
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      EXPECT_EQ(image.row(y)[x] == kNoDisparity, ratio.row(y)[x] == 0) << x << ", " << y;
    }
  }
  reference::RatedMap out(map.width, map.height);
  out.map = copy_of(image);
  out.ratio = copy_of(ratio);
  return out;
}

DisparityPlane matched(const CostVolume& volume, const PixelMatchingOptions& options,
                       const DisparityPlane& map) {
  return rated(volume, options, map).map;
}

/// Compares disparities and peak ratios; returns the number of disparities.
long expect_reference(const RandomVolume& volume, const PixelMatchingOptions& options,
                      const DisparityPlane& map) {
  const reference::RatedMap expected =
      reference::match_pixels(volume.plain, fitting(volume.fast, options), map);
  const reference::RatedMap actual = rated(volume.fast, options, map);
  const SelectionOptions& selection = options.selection;
  SCOPED_TRACE(testing::Message() << "range " << options.range.range << ", confidence "
                                  << selection.confidence << ", in range "
                                  << selection.runner_up_in_range << ", tolerance "
                                  << selection.left_right_tolerance << ", subpixel "
                                  << selection.subpixel);
  EXPECT_TRUE(same_image(expected.map, actual.map));
  EXPECT_TRUE(same_image(expected.ratio, actual.ratio));
  return static_cast<long>(expected.map.pixels.size()) -
         std::count(expected.map.pixels.begin(), expected.map.pixels.end(), 0);
}

/// Random guesses, all of them possible.
DisparityPlane random_guesses(int width, int height, int disparities, Random& random) {
  DisparityPlane map(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 1; x < width; ++x) {
      const int largest = 256 * std::min(x, disparities) - 1;
      if (random.below(4) > 0 && largest > 0) map(x, y) = random.between(1, largest);
    }
  }
  return map;
}

TEST(PixelMatching, EqualsReferenceAtEveryWidth) {
  long known = 0;
  for (int width = 1; width <= 70; ++width) {
    Random random(width);
    const int disparities = random.between(1, width);
    const RandomVolume volume = test::random_volume(width, 7, disparities, width % 2, random, 400);
    const DisparityPlane map = random_guesses(width, 7, disparities, random);
    for (const double range : {0.0, 0.15, 1.0}) {
      for (const double confidence : {0.0, 0.04, 2.0}) {
        for (const bool subpixel : {false, true}) {
          known += expect_reference(volume, paper(range, confidence, subpixel), map);
        }
      }
    }
  }
  EXPECT_GT(known, 10000) << "too few results to compare";
}

TEST(PixelMatching, EqualsReferenceWithEveryChoice) {
  long known = 0;
  for (int width = 1; width <= 70; ++width) {
    Random random(1000 + width);
    const int disparities = random.between(1, width);
    // Few different costs, so that many are equal, or many.
    const int largest = width % 3 == 0 ? 5 : 4000;
    const RandomVolume volume =
        test::random_volume(width, 5, disparities, width % 2, random, largest);
    const DisparityPlane map = random_guesses(width, 5, disparities, random);
    for (const int tolerance : {-1, 0, 1, 20}) {
      for (const bool in_range : {false, true}) {
        const SelectionOptions selection = {0,         0.04 * random.below(2), in_range,
                                            tolerance, random.below(2) == 0,   0};
        known += expect_reference(volume, {{0.15, 0}, selection}, map);
      }
    }
  }
  EXPECT_GT(known, 10000) << "too few results to compare";
}

/// A volume of one row of 100 px whose costs at column 90 are `costs`.
struct OnePixel {
  explicit OnePixel(const std::vector<int>& costs) {
    Random random(1);
    volume = test::random_volume(100, 1, static_cast<int>(costs.size()), 0, random, 0);
    for (std::size_t d = 0; d < costs.size(); ++d) {
      volume.fast.cells[d * volume.fast.stride + kColumn] = static_cast<std::uint16_t>(costs[d]);
    }
  }
  /// The disparity that matching finds from a guess [1/256 px].
  int match(int guess, const PixelMatchingOptions& options) const {
    DisparityPlane map(100, 1);
    map(kColumn, 0) = guess;
    return matched(volume.fast, options, map)(kColumn, 0);
  }
  static constexpr int kColumn = 90;
  RandomVolume volume;
};

TEST(PixelMatching, FindsTheLeastCostNearTheGuess) {
  std::vector<int> costs(60, 1000);
  costs[42] = 100;
  EXPECT_EQ(42 * 256, OnePixel(costs).match(40 * 256, paper(0.15, 0.12, false)));
  EXPECT_EQ(42 * 256, OnePixel(costs).match(38 * 256, paper(0.15, 0.12, false)));
}

TEST(PixelMatching, SearchesBothEndsOfTheRange) {
  for (const int best : {17, 23}) {
    std::vector<int> costs(60, 1000);
    costs[best] = 100;
    EXPECT_EQ(best * 256, OnePixel(costs).match(20 * 256, paper(0.15, 0.12, false)))
        << "20 +- 3 px";
    EXPECT_EQ(0, OnePixel(costs).match(20 * 256 + (best < 20 ? 1 : -1), paper(0.15, 0.12, false)))
        << "just outside of the range; all other costs are equal";
  }
}

TEST(PixelMatching, SearchesAFewPixelsAroundSmallDisparities) {
  std::vector<int> costs(30, 1000);
  costs[5] = 100;
  EXPECT_EQ(5 * 256, OnePixel(costs).match(2 * 256, paper(0.15, 0.12, false)));
}

TEST(PixelMatching, RejectsADisparityWithACloseRunnerUp) {
  std::vector<int> costs(60, 1000);
  costs[20] = 100;
  for (const int runner_up : {18, 22}) {
    std::vector<int> rival = costs;
    rival[runner_up] = 112;
    EXPECT_EQ(0, OnePixel(rival).match(20 * 256, paper(0.15, 0.12, false)))
        << "12 % is not more than 12 %";
    rival[runner_up] = 113;
    EXPECT_EQ(20 * 256, OnePixel(rival).match(20 * 256, paper(0.15, 0.12, false)));
  }
}

TEST(PixelMatching, IgnoresTheNeighborsOfTheBestAsRunnersUp) {
  std::vector<int> costs(60, 1000);
  costs[19] = costs[21] = 101;
  costs[20] = 100;
  EXPECT_EQ(20 * 256, OnePixel(costs).match(20 * 256, paper(0.15, 0.12, false)));
}

TEST(PixelMatching, RejectsADisparityWithoutARunnerUp) {
  EXPECT_EQ(0, OnePixel({5}).match(1, paper(0.15, 0.0, true))) << "one disparity";
  EXPECT_EQ(0, OnePixel({5, 900}).match(1, paper(0.15, 0.0, true))) << "two disparities";
  EXPECT_EQ(1, OnePixel({5, 900, 900}).match(1, paper(0.15, 0.0, true)))
      << "disparity 0 is written as 1/256 px";
}

TEST(PixelMatching, SearchesTheRunnerUpInTheGivenRange) {
  std::vector<int> costs(60, 1000);
  costs[20] = 100;
  costs[50] = 101;
  PixelMatchingOptions options = paper(0.15, 0.12, false);
  EXPECT_EQ(20 * 256, OnePixel(costs).match(20 * 256, options));
  options.selection.runner_up_in_range = false;
  EXPECT_EQ(0, OnePixel(costs).match(20 * 256, options));
}

TEST(PixelMatching, RejectsADisparityThatTheRightPixelContradicts) {
  // Right pixel 70 corresponds to left pixel 90 at 20 px and to left pixel 92 at 22 px.
  std::vector<int> costs(60, 1000);
  costs[20] = 100;
  OnePixel pixel(costs);
  for (int d = 0; d < 60; ++d) {
    std::uint16_t* row = &pixel.volume.fast.cells[d * pixel.volume.fast.stride];
    for (int x = 0; x < 100; ++x) {
      if (x != OnePixel::kColumn) row[x] = 1000;
    }
  }
  pixel.volume.fast.cells[22 * pixel.volume.fast.stride + OnePixel::kColumn + 2] = 99;
  for (const int tolerance : {-1, 0, 1, 2, 3}) {
    PixelMatchingOptions options = paper(0.15, 0.12, false);
    options.selection.left_right_tolerance = tolerance;
    EXPECT_EQ(tolerance < 0 || tolerance >= 2 ? 20 * 256 : 0, pixel.match(20 * 256, options))
        << "tolerance " << tolerance;
  }
}

TEST(PixelMatching, RefinesByTheParabolaThroughThreeCosts) {
  std::vector<int> costs(60, 2000);
  for (const auto& [before, after] : {std::pair{300, 300}, {200, 400}, {101, 999}, {700, 100}}) {
    costs[19] = before;
    costs[20] = 100;
    costs[21] = after;
    const double a = (before + after) / 2.0 - 100, b = (after - before) / 2.0;
    EXPECT_NEAR(256 * (20 - b / (2 * a)), OnePixel(costs).match(20 * 256, paper(0.15, 0.12, true)),
                1)
        << before << ", 100, " << after;
  }
}

TEST(PixelMatching, StaysInTheRangeAtItsEnds) {
  std::vector<int> costs(60, 1000);
  costs[59] = 100;
  EXPECT_EQ(59 * 256, OnePixel(costs).match(59 * 256, paper(0.15, 0.12, true)));
  costs[0] = 50;
  EXPECT_EQ(1, OnePixel(costs).match(1 * 256, paper(0.15, 0.12, true)));
}

}  // namespace
}  // namespace mtstereo::pixel_matching_test
