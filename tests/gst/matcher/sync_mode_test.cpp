// SPDX-License-Identifier: LGPL-2.1-or-later
// The property sync-mode: pairs by other times than the running times.
#include <gtest/gtest.h>

#include "support/defective_streams.hpp"

namespace mtstereo::test {
namespace {

constexpr Nanoseconds kMs = 1'000'000;

FeedOptions with_mode(const std::string& mode) {
  FeedOptions options;
  options.properties = "max-disparity=64 threads=1 sync-mode=" + mode;
  return options;
}

void expect_all_right(const FeedResult& result, int maps) {
  EXPECT_EQ(result.error, "");
  EXPECT_EQ(result.count.maps, maps) << summary(result);
  EXPECT_EQ(result.count.wrong + result.count.unknown, 0) << summary(result);
  EXPECT_TRUE(result.warnings.empty()) << summary(result);
}

TEST(SyncMode, ArrivalPairsInOrderWhateverTheTimes) {
  const auto left = defective_sequence(60, {}, 1);
  for (const Defects& defects : {Defects{.skew = 25 * kMs}, Defects{.skew = 10'000 * kMs},
                                 Defects{.drift = 0.01}, Defects{.jitter = 100 * kMs}}) {
    expect_all_right(feed(left, defective_sequence(60, defects, 2), with_mode("arrival")), 60);
  }
}

TEST(SyncMode, ArrivalPairsFramesWithoutTimesOnOneSide) {
  auto right = defective_sequence(60, {}, 1);
  for (NumberedFrame& frame : right) frame.pts = GST_CLOCK_TIME_NONE;
  expect_all_right(feed(defective_sequence(60, {}, 1), right, with_mode("arrival")), 60);
}

TEST(SyncMode, ArrivalEndsWithTheShorterStream) {
  expect_all_right(
      feed(defective_sequence(60, {}, 1), defective_sequence(40, {}, 1), with_mode("arrival")), 40);
}

TEST(SyncMode, FirstPtsRemovesAConstantOffset) {
  const auto left = defective_sequence(100, {}, 1);
  for (const Nanoseconds offset : {10'000 * kMs, -900 * kMs, 25 * kMs, 16 * kMs}) {
    expect_all_right(
        feed(left, defective_sequence(100, {.skew = offset}, 2), with_mode("first-pts")), 100);
  }
}

TEST(SyncMode, FirstPtsSurvivesLossAndJitter) {
  const Defects loss{.jitter = 4 * kMs, .loss = 0.1};
  Defects late = loss;
  late.skew = 10'000 * kMs;
  for (unsigned seed = 1; seed <= 3; ++seed) {
    // The first frames must be a pair.
    auto left = defective_sequence(120, loss, 2 * seed);
    auto right = defective_sequence(120, late, 2 * seed + 1);
    while (left.front().number != right.front().number) {
      auto& earlier = left.front().number < right.front().number ? left : right;
      earlier.erase(earlier.begin());
    }
    const FeedResult result = feed(left, right, with_mode("first-pts"));
    EXPECT_GT(result.count.maps, 80) << summary(result);
    EXPECT_EQ(wrong_without_warning(result), 0) << summary(result);
  }
}

/// Frames with running times that say nothing, and NTP times from `skew` on.
std::vector<NumberedFrame> with_reference(int count, Nanoseconds skew, double loss, unsigned seed) {
  auto frames = defective_sequence(count, {.loss = loss}, seed);
  const auto false_times = defective_sequence(
      count, {.skew = static_cast<Nanoseconds>(seed) * 40 * kMs, .drift = 0.01}, seed);
  constexpr GstClockTime kNow = 3'900'000'000u * GST_SECOND;
  for (NumberedFrame& frame : frames) {
    frame.reference = kNow + frame.pts + static_cast<GstClockTime>(skew);
    frame.pts = false_times[static_cast<std::size_t>(frame.number)].pts;
  }
  return frames;
}

TEST(SyncMode, ReferenceTimestampPairsByTheTimesOfTheMetas) {
  const FeedOptions options = with_mode("reference-timestamp");
  expect_all_right(feed(with_reference(100, 0, 0, 1), with_reference(100, 0, 0, 2), options), 100);
  expect_all_right(feed(with_reference(100, 0, 0, 1), with_reference(100, 2 * kMs, 0, 5), options),
                   100);
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const FeedResult result =
        feed(with_reference(100, 0, 0.1, seed), with_reference(100, kMs, 0.1, seed + 3), options);
    EXPECT_EQ(result.count.wrong + result.count.unknown, 0) << summary(result);
    EXPECT_GT(result.count.maps, 70) << summary(result);
  }
}

TEST(SyncMode, ReferenceTimestampNamesThePadWithoutOne) {
  for (const bool left : {true, false}) {
    auto lefts = with_reference(10, 0, 0, 1);
    auto rights = with_reference(10, 0, 0, 2);
    (left ? lefts : rights)[0].reference = GST_CLOCK_TIME_NONE;
    const FeedResult result = feed(lefts, rights, with_mode("reference-timestamp"));
    const std::string pad = left ? "sink_left" : "sink_right";
    EXPECT_NE(result.error.find("A frame of " + pad), std::string::npos) << result.error;
  }
}

}  // namespace
}  // namespace mtstereo::test
