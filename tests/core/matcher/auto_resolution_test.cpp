// SPDX-License-Identifier: LGPL-2.1-or-later
// resolution=auto: which frames of a stream are matched at half resolution.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "matcher/resolution_choice.hpp"
#include "support/compare.hpp"
#include "support/matching.hpp"
#include "support/soft_pair.hpp"

namespace mtstereo::auto_resolution_test {
namespace {

using test::Pair;

constexpr int kFrames = ResolutionChoice::kFrames;

const Pair& sharp() {
  static const Pair pair = test::slanted_pair(240, 120, 30, 1);
  return pair;
}

const Pair& soft() {
  static const Pair pair = softened(sharp());
  return pair;
}

/// Whether each of `frames` frames of this pair is matched at half resolution: "full half ...".
std::string resolutions(Matcher& matcher, const Pair& pair, int frames) {
  std::string text;
  for (int i = 0; i < frames; ++i) {
    const test::Matched matched = test::match(matcher, pair.left, pair.right);
    text += matched.statistics.half_resolution ? "half " : "full ";
  }
  return text;
}

std::string repeated(const std::string& word, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += word;
  return text;
}

Matcher auto_matcher() { return test::matcher({{"resolution", "auto"}}); }

Matcher matcher_at_half() {
  Matcher matcher = auto_matcher();
  resolutions(matcher, soft(), kFrames);
  EXPECT_EQ("half ", resolutions(matcher, soft(), 1));
  return matcher;
}

TEST(AutoResolution, StaysFullForSharpViews) {
  Matcher matcher = auto_matcher(), full = test::matcher({});
  const DisparityPlane expected = test::compute(full, sharp().left, sharp().right);
  for (int i = 0; i < 3 * kFrames; ++i) {
    const test::Matched matched = test::match(matcher, sharp().left, sharp().right);
    EXPECT_TRUE(same_image(expected, matched.map)) << i;
    EXPECT_FALSE(matched.statistics.half_resolution) << i;
    EXPECT_GE(matched.statistics.fine_detail, ResolutionChoice::kSharp);
  }
}

// Feature: reduced resolution for speed
TEST(AutoResolution, IsHalfForSoftViewsWithTheResultsOfHalfRefined) {
  Matcher matcher = auto_matcher();
  Matcher full = test::matcher({}), half = test::matcher({{"resolution", "half-refined"}});
  const test::Matched at_full = test::match(full, soft().left, soft().right);
  const test::Matched at_half = test::match(half, soft().left, soft().right);
  for (int i = 0; i < 3 * kFrames; ++i) {
    const test::Matched& expected = i < kFrames ? at_full : at_half;
    const test::Matched matched = test::match(matcher, soft().left, soft().right);
    EXPECT_TRUE(same_image(expected.map, matched.map)) << i;
    EXPECT_TRUE(same_image(expected.confidence, matched.confidence)) << i;
    EXPECT_LE(matched.statistics.fine_detail, ResolutionChoice::kSoft);
  }
}

TEST(AutoResolution, ReturnsToFullWhenTheViewsAreSharpAgain) {
  Matcher matcher = matcher_at_half();
  EXPECT_EQ(repeated("half ", kFrames) + "full full ", resolutions(matcher, sharp(), kFrames + 2));
}

TEST(AutoResolution, StaysForViewsWithoutTexture) {
  const Pair blank = {test::GrayPlane(240, 120, 90), test::GrayPlane(240, 120, 90)};
  Matcher full = auto_matcher(), half = matcher_at_half();
  EXPECT_EQ(repeated("full ", 2 * kFrames), resolutions(full, blank, 2 * kFrames));
  EXPECT_EQ(repeated("half ", 2 * kFrames), resolutions(half, blank, 2 * kFrames));
  EXPECT_EQ(0, test::match(half, blank.left, blank.right).statistics.fine_detail);
}

TEST(AutoResolution, BeginsAnewWithAnotherStream) {
  Matcher restarted = matcher_at_half();
  restarted.restart();
  EXPECT_EQ(repeated("full ", kFrames) + "half ", resolutions(restarted, soft(), kFrames + 1));

  Matcher resized = matcher_at_half();
  const Pair other = softened(test::slanted_pair(200, 100, 20, 2));
  EXPECT_EQ(repeated("full ", kFrames) + "half ", resolutions(resized, other, kFrames + 1));

  Matcher reset = matcher_at_half();
  ASSERT_TRUE(reset.set_parameters(test::parameters({{"resolution", "full"}})).ok());
  const FrameStatistics at_full = test::match(reset, soft().left, soft().right).statistics;
  EXPECT_FALSE(at_full.half_resolution);
  EXPECT_EQ(0, at_full.fine_detail);
  ASSERT_TRUE(reset.set_parameters(test::parameters({{"resolution", "auto"}})).ok());
  EXPECT_EQ(repeated("full ", kFrames) + "half ", resolutions(reset, soft(), kFrames + 1));
}

TEST(AutoResolution, IsKeptWhenOtherParametersOrTheCorrectionChange) {
  Matcher matcher = matcher_at_half();
  const Parameters next = test::parameters({{"resolution", "auto"}, {"max-disparity", "48"}});
  ASSERT_TRUE(matcher.set_parameters(next).ok());
  EXPECT_EQ("half ", resolutions(matcher, soft(), 1));
  Matcher half = test::matcher({{"resolution", "half-refined"}, {"max-disparity", "48"}});
  EXPECT_TRUE(same_image(test::compute(half, soft().left, soft().right),
                         test::compute(matcher, soft().left, soft().right)));
  ASSERT_TRUE(matcher.set_correction({{0.5, 0, 0, 0, 0}, 0, 0}).ok());
  EXPECT_EQ("half ", resolutions(matcher, soft(), 1));
}

TEST(AutoResolution, IsTheSameForAnyNumberOfThreads) {
  std::vector<double> expected;
  for (const char* const threads : {"1", "2", "5"}) {
    Matcher matcher = test::matcher({{"resolution", "auto"}, {"threads", threads}});
    std::vector<double> details;
    for (int i = 0; i < 2 * kFrames; ++i) {
      const Pair& pair = i == 3 ? sharp() : soft();
      const FrameStatistics statistics = test::match(matcher, pair.left, pair.right).statistics;
      details.push_back(statistics.fine_detail + (statistics.half_resolution ? 10 : 0));
    }
    EXPECT_GT(details.back(), 10);
    if (expected.empty()) expected = details;
    EXPECT_EQ(expected, details) << threads << " threads";
  }
}

TEST(AutoResolution, WorksInEveryModeOfEveryPreset) {
  for (const char* const preset : {"default", "fast", "paper"}) {
    for (const char* const mode : {"sparse", "semi-dense", "dense", "full"}) {
      SCOPED_TRACE(testing::Message() << preset << ", " << mode);
      const Pair large = softened(test::slanted_pair(320, 160, 30, 3));
      Matcher matcher = test::matcher({{"resolution", "auto"}, {"preset", preset}, {"mode", mode}});
      EXPECT_EQ(repeated("full ", kFrames) + "half ", resolutions(matcher, large, kFrames + 1));
    }
  }
}

TEST(AutoResolution, WorksWithEverySmallestDisparity) {
  for (const char* const least : {"-20", "5"}) {
    Matcher matcher = test::matcher({{"resolution", "auto"}, {"min-disparity", least}});
    EXPECT_EQ(repeated("full ", kFrames) + "half ", resolutions(matcher, soft(), kFrames + 1))
        << least;
    EXPECT_EQ(repeated("half ", kFrames) + "full ", resolutions(matcher, sharp(), kFrames + 1))
        << least;
  }
}

TEST(AutoResolution, IsNoDefault) {
  Matcher full = test::matcher({}), fast = test::matcher({{"preset", "fast"}});
  EXPECT_EQ(repeated("full ", kFrames + 1), resolutions(full, soft(), kFrames + 1));
  EXPECT_EQ(repeated("half ", kFrames + 1), resolutions(fast, sharp(), kFrames + 1));
}

TEST(AutoResolution, RefusesNodesThatFitAtNeitherResolution) {
  const Parameters wide = test::parameters(
      {{"resolution", "auto"}, {"min-node-width", "90"}, {"max-node-width", "0.5"}});
  EXPECT_TRUE(test::fails_with(wide.check_frame(240, 120), ErrorCode::kInvalidCombination,
                               {"min-node-width", "half resolution"}));
}

}  // namespace
}  // namespace mtstereo::auto_resolution_test
