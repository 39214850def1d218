// SPDX-License-Identifier: LGPL-2.1-or-later
// Searches that do not begin at a disparity of 0.
#include <gtest/gtest.h>

#include "base/limits.hpp"
#include "support/compare.hpp"
#include "support/matching.hpp"
#include "support/random.hpp"

namespace mtstereo::min_disparity_test {
namespace {

using test::fails_with;
using test::Pair;

constexpr const char* kPresetNames[] = {"default", "fast", "paper"};

/// The view of a right camera whose disparities are `by` px larger; its border is repeated.
GrayPlane moved(const GrayPlane& view, int by) {
  GrayPlane out(view.width, view.height);
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      out(x, y) = view(std::clamp(x + by, 0, view.width - 1), y);
    }
  }
  return out;
}

/// Parameters that search the disparities least .. least + 47.
Parameters range_from(int least, const char* preset, const char* mode) {
  return test::parameters({{"preset", preset},
                           {"mode", mode},
                           {"min-confidence", "0"},
                           {"noise-filter", "false"},
                           {"min-disparity", std::to_string(least)},
                           {"max-disparity", std::to_string(least + 48)}});
}

/// The disparities of a map [1 / kDisparityOne px] plus kDisparityOne * 2000; 0: none.
DisparityPlane disparities(Matcher& matcher, const GrayPlane& left, const GrayPlane& right) {
  DisparityPlane map = test::compute(matcher, left, right);
  for (std::int32_t& value : map.pixels) {
    if (value != kNoDisparity) {
      value += (matcher.parameters().disparity_offset() + 2000) * kDisparityOne;
    }
  }
  return map;
}

/// Compares the columns that are not near the border, where `by` px are added to `unmoved`.
void expect_moved(const DisparityPlane& unmoved, const DisparityPlane& map, int by) {
  constexpr int kBorder = 180;
  EXPECT_TRUE(test::same_pixels(
      map.width - 2 * kBorder, map.height,
      [&](int x, int y) {
        const int value = unmoved(x + kBorder, y);
        return value == 0 ? 0 : value + by * kDisparityOne;
      },
      [&](int x, int y) { return map(x + kBorder, y); }));
}

// Feature: any search range, also negative
TEST(MinDisparity, OfAMovedViewGivesTheMovedMap) {
  const Pair pair = test::slanted_pair(640, 60, 40, 5);
  for (const char* const preset : kPresetNames) {
    for (const char* const mode : {"sparse", "semi-dense"}) {
      Matcher matcher = std::move(Matcher::create(range_from(0, preset, mode)).value());
      const DisparityPlane unmoved = disparities(matcher, pair.left, pair.right);
      EXPECT_GT(test::known(unmoved), 200);
      for (const int by : {-32, 64}) {
        SCOPED_TRACE(testing::Message() << preset << ", " << mode << ", " << by << " px");
        ASSERT_TRUE(matcher.set_parameters(range_from(by, preset, mode)).ok());
        expect_moved(unmoved, disparities(matcher, pair.left, moved(pair.right, by)), by);
      }
    }
  }
}

TEST(MinDisparity, IsAppliedAfterTheCorrection) {
  Pair pair = test::slanted_pair(640, 60, 40, 6);
  for (GrayPlane* view : {&pair.left, &pair.right}) {
    // With more contrast, the blur of one view is a response that depends on all columns.
    for (std::uint8_t& gray : view->pixels) gray = static_cast<std::uint8_t>(64 + gray / 4);
  }
  ViewCorrection correction;  // one that does not depend on the column
  correction.rows.offset = 0.5;
  correction.left_blur = 1;
  Matcher matcher = std::move(Matcher::create(range_from(0, "default", "semi-dense")).value());
  ASSERT_TRUE(matcher.set_correction(correction).ok());
  const DisparityPlane unmoved = disparities(matcher, pair.left, pair.right);
  EXPECT_GT(test::known(unmoved), 200);
  for (const int by : {-32, 32}) {
    ASSERT_TRUE(matcher.set_parameters(range_from(by, "default", "semi-dense")).ok());
    expect_moved(unmoved, disparities(matcher, pair.left, moved(pair.right, by)), by);
  }
}

TEST(MinDisparity, MayBeFarBelowMinusTheWidth) {
  const Pair pair = test::shifted_pair(60, 40, 3, 7);
  for (const char* const mode : {"sparse", "semi-dense", "dense", "full"}) {
    Matcher matcher =
        test::matcher({{"mode", mode}, {"min-disparity", "-700"}, {"max-disparity", "20"}});
    const DisparityPlane map = test::compute(matcher, pair.left, pair.right);
    EXPECT_EQ(60, map.width) << mode;
  }
}

TEST(MinDisparity, IsTheSmallestOneAndEveryPartnerIsInTheRightView) {
  for (const std::string preset : kPresetNames) {
    for (const int least : {-60, -1, 1, 33}) {
      SCOPED_TRACE(testing::Message() << preset << ", " << least << " px");
      // With the pyramid, the preset default infers disparities, of low confidence.
      const char* const matched = preset == "default" ? "16" : "0";
      const Pair pair = {test::noise(151, 40, 3), test::noise(151, 40, 4)};
      const Parameters parameters = test::parameters({{"preset", preset},
                                                      {"mode", "semi-dense"},
                                                      {"pixel-confidence", "0"},
                                                      {"min-confidence", matched},
                                                      {"speckle-size", "0"},
                                                      {"min-disparity", std::to_string(least)},
                                                      {"max-disparity", "60"}});
      Matcher matcher = std::move(Matcher::create(parameters).value());
      const test::Matched result = test::match(matcher, pair.left, pair.right);
      const DisparityPlane& map = result.map;
      const GrayPlane& confidence = result.confidence;
      EXPECT_EQ(map.width, 151);
      EXPECT_EQ(confidence.width, 151);
      const int offset = parameters.disparity_offset() * kDisparityOne;
      EXPECT_TRUE(test::same_pixels(
          151, 40, [](int, int) { return true; },
          [&](int x, int y) {
            if (map(x, y) == kNoDisparity) return confidence(x, y) == 0;
            const int d = map(x, y) + offset;
            const int partner = x * kDisparityOne - d;
            return d >= least * kDisparityOne && d < 60 * kDisparityOne && partner >= 0 &&
                   partner <= 150 * kDisparityOne;
          }));
    }
  }
}

// Feature: any search range, also negative
TEST(MinDisparity, OfConvergingCamerasFindsNegativeDisparities) {
  const Pair pair = test::shifted_pair(320, 80, 0, 7);
  Matcher matcher = test::matcher({{"min-disparity", "-30"}, {"max-disparity", "20"}});
  const auto [map, confidence, statistics] =
      test::match(matcher, pair.left, moved(pair.right, -12));
  EXPECT_GT(statistics.density, 0.3);
  long near = 0;
  for (const std::int32_t value : map.pixels) {
    const double px = value / 256.0 + matcher.parameters().disparity_offset();
    near += value != kNoDisparity && std::abs(px + 12) < 1;
  }
  EXPECT_GT(near, 0.97 * static_cast<double>(test::known(map)));
}

TEST(MinDisparity, HasAnOffsetOnlyIfItIsNegative) {
  EXPECT_EQ(Parameters().disparity_offset(), 0);
  EXPECT_EQ(test::parameters({{"min-disparity", "9"}}).disparity_offset(), 0);
  EXPECT_EQ(test::parameters({{"min-disparity", "-9"}}).disparity_offset(), -9);
}

TEST(MinDisparity, MustBeLessThanTheLargestOne) {
  for (const char* const least : {"64", "65", "1000"}) {
    const Parameters parameters = test::parameters({{"min-disparity", least}});
    EXPECT_TRUE(fails_with(parameters.check_frame(640, 480), ErrorCode::kInvalidCombination,
                           {"min-disparity = ", least, "at most 63 px"}));
    EXPECT_TRUE(fails_with(parameters.check_scale16(16), ErrorCode::kInvalidCombination,
                           {"min-disparity = ", least}));
    Matcher matcher = std::move(Matcher::create(parameters).value());
    const GrayPlane view = test::noise(128, 16, 1);
    EXPECT_FALSE(matcher.compute(view.view(), view.view()).ok());
  }
  EXPECT_TRUE(test::parameters({{"min-disparity", "63"}}).check_frame(640, 480).ok());
}

// Feature: any search range, also negative
TEST(MinDisparity, MayNotLeaveMoreDisparitiesThanPossible) {
  const int most = kLargestMaxDisparity - kLargestMinDisparity;
  Parameters parameters =
      test::parameters({{"min-disparity", std::to_string(-kLargestMinDisparity)},
                        {"max-disparity", std::to_string(most)}});
  EXPECT_TRUE(parameters.check_frame(4000, 480).ok());
  ASSERT_TRUE(parameters.set(Parameter::kMaxDisparity, most + 1).ok());
  EXPECT_TRUE(fails_with(parameters.check_frame(4000, 480), ErrorCode::kInvalidCombination,
                         {"min-disparity = -1024", std::to_string(kLargestMaxDisparity)}));
}

TEST(MinDisparity, CountsForSixteenBitsIfItIsNegative) {
  const Parameters parameters =
      test::parameters({{"min-disparity", "-100"}, {"max-disparity", "155"}});
  EXPECT_TRUE(parameters.check_scale16(257).ok()) << "255 * 257 = 65535";
  EXPECT_TRUE(fails_with(parameters.check_scale16(258), ErrorCode::kInvalidCombination,
                         {"min-disparity = -100", "1 to 257", "at most 154"}));
  const Parameters positive =
      test::parameters({{"min-disparity", "100"}, {"max-disparity", "255"}});
  EXPECT_TRUE(positive.check_scale16(257).ok());
  EXPECT_FALSE(positive.check_scale16(258).ok());
}

}  // namespace
}  // namespace mtstereo::min_disparity_test
