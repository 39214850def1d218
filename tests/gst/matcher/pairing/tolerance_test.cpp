// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/pairing/tolerance.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "matcher/pairing/unpaired.hpp"

namespace mtstereo::plugin::tolerance_test {
namespace {

constexpr Nanoseconds kMs = 1'000'000;

TEST(BoundedTime, KeepsTimesInRange) {
  for (const Nanoseconds time : {Nanoseconds{0}, kMs, -3600'000 * kMs, kFarthestTime}) {
    EXPECT_EQ(bounded(time), time);
  }
  EXPECT_EQ(bounded(std::uint64_t{5}), 5);
  EXPECT_EQ(bounded(-2.75), -2);
}

TEST(BoundedTime, IsTheNearestInRange) {
  EXPECT_EQ(bounded(std::numeric_limits<std::int64_t>::max()), kFarthestTime);
  EXPECT_EQ(bounded(std::numeric_limits<std::int64_t>::min()), -kFarthestTime);
  EXPECT_EQ(bounded(std::numeric_limits<std::uint64_t>::max()), kFarthestTime);
  EXPECT_EQ(bounded(1e300), kFarthestTime);
  EXPECT_EQ(bounded(-std::numeric_limits<double>::infinity()), -kFarthestTime);
}

TEST(Tolerance, IsTheValueThatIsSet) {
  EXPECT_EQ(effective_tolerance(7, {40 * kMs, 40 * kMs}, {20 * kMs, 20 * kMs}), 7);
  EXPECT_EQ(effective_tolerance(0, {40 * kMs, 40 * kMs}, {}), 0);
}

TEST(Tolerance, IsHalfTheFrameDurationOfTheFasterStream) {
  EXPECT_EQ(effective_tolerance(-1, {40 * kMs, 20 * kMs}, {2 * kMs, 2 * kMs}), 10 * kMs);
  EXPECT_EQ(effective_tolerance(-1, {20 * kMs, 40 * kMs}, {}), 10 * kMs);
  EXPECT_EQ(effective_tolerance(-1, {std::nullopt, 40 * kMs}, {2 * kMs, 2 * kMs}), 20 * kMs);
}

TEST(Tolerance, FallsBackToTheBuffersThenToTwentyMilliseconds) {
  EXPECT_EQ(effective_tolerance(-1, {}, {60 * kMs, std::nullopt}), 30 * kMs);
  EXPECT_EQ(effective_tolerance(-1, {}, {}), 20 * kMs);
}

TEST(WaitingFrame, HasItsTimeAsDeadlineIfInTime) {
  WaitingFrame frame;
  EXPECT_EQ(frame.deadline(true, 100 * kMs, 110 * kMs, 50 * kMs), 100 * kMs);
  EXPECT_EQ(frame.deadline(true, 100 * kMs, 140 * kMs, 50 * kMs), 100 * kMs) << "seen again";
}

TEST(WaitingFrame, HasOneGracePeriodIfLate) {
  WaitingFrame frame;
  constexpr Nanoseconds kNow = 400 * kMs;
  const Nanoseconds expected = kNow + WaitingFrame::kGrace - 50 * kMs;
  EXPECT_EQ(frame.deadline(true, 100 * kMs, kNow, 50 * kMs), expected);
  EXPECT_EQ(frame.deadline(true, 100 * kMs, kNow + 10 * kMs, 50 * kMs), expected)
      << "the grace period must not restart";
  EXPECT_EQ(frame.deadline(false, 100 * kMs, kNow + 10 * kMs, 50 * kMs), expected + 10 * kMs)
      << "a frame of the other side has its own grace period";
}

TEST(UnpairedWarning, IsDueAfterARunOfDroppedFrames) {
  UnpairedWarning warning;
  for (int i = 1; i < UnpairedWarning::kRun; ++i) EXPECT_FALSE(warning.dropped(i)) << i;
  EXPECT_TRUE(warning.dropped(UnpairedWarning::kRun));
}

TEST(UnpairedWarning, IsNotDueIfEverySecondFrameHasAPartner) {
  UnpairedWarning warning;
  for (int i = 0; i < 10 * UnpairedWarning::kRun; ++i) {
    EXPECT_FALSE(warning.dropped(i * UnpairedWarning::kInterval)) << i;
    warning.paired();
  }
}

TEST(UnpairedWarning, IsDueAgainOnlyAfterTheInterval) {
  UnpairedWarning warning;
  for (int i = 1; i < UnpairedWarning::kRun; ++i) warning.dropped(0);
  EXPECT_TRUE(warning.dropped(0));
  EXPECT_FALSE(warning.dropped(UnpairedWarning::kInterval - 1));
  EXPECT_TRUE(warning.dropped(UnpairedWarning::kInterval));
}

}  // namespace
}  // namespace mtstereo::plugin::tolerance_test
