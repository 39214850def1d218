// SPDX-License-Identifier: LGPL-2.1-or-later
// Streams with skew, drift, jitter, lost frames and wrong time stamps: no pair is wrong, or a
// warning comes before the first one.
#include <gtest/gtest.h>

#include <ostream>

#include "support/defective_streams.hpp"

namespace mtstereo::test::wrong_pairs_test {
namespace {

constexpr Nanoseconds kMs = 1'000'000;

FeedOptions with_tolerance(int milliseconds) {
  FeedOptions options;
  options.properties = kNumberedMatching;
  if (milliseconds > 0) {
    options.properties += " sync-tolerance=" + std::to_string(milliseconds * kMs);
  }
  return options;
}

/// Two streams, the tolerance, and what is expected.
struct Case {
  const char* name;
  Defects left{};
  Defects right{};
  int frames = 200;
  int tolerance = 0;   ///< [ms]; 0: the default
  bool warns = false;  ///< the time stamps alone cannot prove that the pairs are right
};

void PrintTo(const Case& test, std::ostream* stream) { *stream << test.name; }

const Case kCases[] = {
    {.name = "SkewAndLoss",
     .left = {.loss = 0.1},
     .right = {.skew = 15 * kMs, .loss = 0.1},
     .tolerance = 20,
     .warns = true},
    {.name = "NegativeSkewAndLoss",
     .left = {.loss = 0.1},
     .right = {.skew = -15 * kMs, .loss = 0.1},
     .tolerance = 20,
     .warns = true},
    {.name = "SkewAndLossWithTheDefaultTolerance",
     .left = {.loss = 0.1},
     .right = {.skew = 15 * kMs, .loss = 0.1},
     .warns = true},
    {.name = "ModerateSkewAndLoss", .left = {.loss = 0.1}, .right = {.skew = 6 * kMs, .loss = 0.1}},
    {.name = "Drift", .right = {.drift = 0.002}, .frames = 600, .tolerance = 20, .warns = true},
    {.name = "DriftWithTheDefaultTolerance",
     .right = {.drift = 0.002},
     .frames = 600,
     .warns = true},
    {.name = "DriftBackward", .right = {.drift = -0.002}, .frames = 600, .warns = true},
    {.name = "DriftAndLoss",
     .left = {.loss = 0.1},
     .right = {.drift = 0.0003, .loss = 0.1},
     .frames = 400},
    {.name = "SkewOfMoreThanHalfAFrame", .right = {.skew = 25 * kMs}, .warns = true},
    {.name = "SkewOfMoreThanHalfAFrameAndTolerance",
     .right = {.skew = 25 * kMs},
     .tolerance = 20,
     .warns = true},
    {.name = "SkewOfOneAndAHalfFrames", .right = {.skew = 50 * kMs}, .warns = true},
    {.name = "SkewOfOneAndAHalfFramesAndTolerance",
     .right = {.skew = 50 * kMs},
     .tolerance = 20,
     .warns = true},
    {.name = "StrongJitterAndLoss",
     .left = {.loss = 0.1},
     .right = {.jitter = 14 * kMs, .loss = 0.1},
     .warns = true},
    {.name = "StrongJitterAndLossAndTolerance",
     .left = {.loss = 0.1},
     .right = {.jitter = 14 * kMs, .loss = 0.1},
     .tolerance = 20,
     .warns = true},
    {.name = "Jitter", .left = {.jitter = 5 * kMs}, .right = {.jitter = 5 * kMs}},
    {.name = "JitterAndLoss",
     .left = {.jitter = 5 * kMs, .loss = 0.1},
     .right = {.jitter = 5 * kMs, .loss = 0.1},
     .tolerance = 20},
};

class WrongPairs : public testing::TestWithParam<Case> {};

// Feature: pairs by running time, with a tolerance
TEST_P(WrongPairs, AreNeverMatchedInSilence) {
  const Case& test = GetParam();
  // Without chance one run is enough.
  const auto random = [](const Defects& stream) { return stream.jitter > 0 || stream.loss > 0; };
  const unsigned seeds = random(test.left) || random(test.right) ? 3 : 1;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    const auto left = defective_sequence(test.frames, test.left, 2 * seed);
    const auto right = defective_sequence(test.frames, test.right, 2 * seed + 1);
    const FeedResult result = feed(left, right, with_tolerance(test.tolerance));
    EXPECT_EQ(result.error, "");
    EXPECT_EQ(wrong_without_warning(result), 0) << "seed " << seed << ": " << summary(result);
    if (!test.warns) {
      EXPECT_TRUE(result.warnings.empty()) << summary(result);
      EXPECT_GT(result.count.maps, test.frames * 3 / 4) << summary(result);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Streams, WrongPairs, testing::ValuesIn(kCases),
                         [](const auto& info) { return info.param.name; });

// --- wrong time stamps ---

class WrongTimes : public testing::TestWithParam<Side> {
 protected:
  static constexpr std::size_t kFrames = 60;

  /// Frames whose time stamps begin at 5 s.
  static std::vector<NumberedFrame> perfect_frames() {
    return defective_sequence(kFrames, {.skew = 4000 * kMs}, 1);
  }
  FeedResult play(const std::vector<NumberedFrame>& changed) {
    const auto perfect = perfect_frames();
    const bool left = GetParam() == Side::kLeft;
    const FeedResult result =
        feed(left ? changed : perfect, left ? perfect : changed, with_tolerance(0));
    EXPECT_EQ(result.error, "");
    EXPECT_EQ(result.count.wrong + result.count.unknown, 0) << summary(result);
    return result;
  }
};

// Feature: frames without a partner are counted and reported
TEST_P(WrongTimes, CostOnePair) {
  for (const int seconds : {3600, 3, -3}) {
    for (const std::size_t position : {1u, 20u, 58u}) {
      auto changed = perfect_frames();
      changed[position].pts += static_cast<GstClockTime>(seconds * GST_SECOND);
      const FeedResult result = play(changed);
      EXPECT_EQ(result.count.maps, static_cast<int>(kFrames) - 1)
          << seconds << " s at frame " << position << ": " << summary(result);
      EXPECT_EQ(result.stats.wrong_times, 1u) << seconds << " s at frame " << position;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sides, WrongTimes, testing::Values(Side::kLeft, Side::kRight),
                         [](const auto& info) {
                           return info.param == Side::kLeft ? "Left" : "Right";
                         });

// --- statistics ---

// Feature: statistics
TEST(DifferenceStatistics, StateJitter) {
  const FeedResult result =
      feed(defective_sequence(300, {}, 1), defective_sequence(300, {.jitter = 5 * kMs}, 2),
           with_tolerance(0));
  EXPECT_EQ(result.count.wrong, 0);
  EXPECT_NEAR(result.stats.difference_ms, 0, 1.5);
  EXPECT_NEAR(result.stats.difference_spread_ms, 5 / 1.732, 0.6) << "of a uniform distribution";
}

// Feature: statistics
TEST(DifferenceStatistics, StateADrift) {
  const FeedResult result = feed(defective_sequence(200, {}, 1),
                                 defective_sequence(200, {.drift = 0.0005}, 2), with_tolerance(0));
  EXPECT_EQ(result.count.wrong, 0);
  EXPECT_NEAR(result.stats.difference_drift, 0.5, 0.05) << "ms per s";
  EXPECT_NEAR(result.stats.difference_ms, 199.0 / 30 * 0.5, 0.2) << "at the last pair";
}

}  // namespace
}  // namespace mtstereo::test::wrong_pairs_test
