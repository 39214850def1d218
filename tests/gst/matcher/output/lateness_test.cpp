// SPDX-License-Identifier: LGPL-2.1-or-later
// Which pairs are skipped because their maps would be late.
#include "matcher/output/lateness.hpp"

#include <gtest/gtest.h>

#include "matcher/output/latency.hpp"

namespace mtstereo::plugin::lateness_test {
namespace {

constexpr Nanoseconds kMs = 1'000'000;

/// A judge whose sink has shown that it synchronizes, by a map of the time 0 that was early.
Lateness synchronizing(Nanoseconds latency = 0) {
  Lateness lateness;
  lateness.set_latency(latency);
  lateness.sent(0, -50 * kMs);
  lateness.sink_reported(0, -50 * kMs);
  return lateness;
}

TEST(Lateness, IsUnknownUntilASinkReports) {
  Lateness lateness;
  lateness.sent(0, 0);
  EXPECT_EQ(lateness.predict(40 * kMs, 1000 * kMs, 10 * kMs), std::nullopt);
}

TEST(Lateness, IsUnknownIfTheSinkDoesNotSynchronize) {
  Lateness lateness;
  lateness.sent(0, 0);
  for (int i = 0; i < 10; ++i) lateness.sink_reported(0, 0);
  EXPECT_EQ(lateness.predict(40 * kMs, 1000 * kMs, 10 * kMs), std::nullopt);
}

TEST(Lateness, IsUnknownAfterSynchronizationWasSwitchedOff) {
  Lateness lateness = synchronizing();
  lateness.sink_reported(40 * kMs, -31 * kMs);
  EXPECT_TRUE(lateness.predict(80 * kMs, 1000 * kMs, 10 * kMs));
  lateness.sink_reported(80 * kMs, -31 * kMs);  // the last value again
  EXPECT_FALSE(lateness.predict(120 * kMs, 1000 * kMs, 10 * kMs));
  lateness.sink_reported(120 * kMs, -30 * kMs);
  EXPECT_TRUE(lateness.predict(160 * kMs, 1000 * kMs, 10 * kMs));
}

TEST(Lateness, ReportsOfASecondSinkWithoutSynchronizationDoNotCount) {
  Lateness lateness = synchronizing();
  lateness.sink_reported(40 * kMs, 0);
  EXPECT_TRUE(lateness.predict(80 * kMs, 1000 * kMs, 10 * kMs));
}

TEST(Lateness, IsTheTimeAfterMatchingMinusTheTimeOfTheFrame) {
  const Lateness lateness = synchronizing();
  EXPECT_EQ(lateness.predict(100 * kMs, 80 * kMs, 30 * kMs), 10 * kMs);
  EXPECT_EQ(lateness.predict(120 * kMs, 80 * kMs, 30 * kMs), -10 * kMs);
}

TEST(Lateness, TheLatencyOfThePipelineIsAddedToTheTimeOfTheFrame) {
  const Lateness lateness = synchronizing(50 * kMs);
  EXPECT_EQ(lateness.predict(100 * kMs, 80 * kMs, 30 * kMs), -40 * kMs);
}

TEST(Lateness, ALateMapShowsTheTimeToTheSink) {
  Lateness lateness = synchronizing();
  lateness.sent(100 * kMs, 97 * kMs);
  lateness.sink_reported(100 * kMs, 5 * kMs);  // arrived at 105 ms
  EXPECT_EQ(lateness.delay(), 8 * kMs);
  EXPECT_EQ(lateness.predict(200 * kMs, 170 * kMs, 30 * kMs), 8 * kMs);
}

TEST(Lateness, AnEarlyMapThatWaitedInAQueueDoesNotIncreaseTheTimeToTheSink) {
  Lateness lateness = synchronizing();
  lateness.sent(1000 * kMs, 100 * kMs);
  lateness.sink_reported(1000 * kMs, -40 * kMs);
  EXPECT_EQ(lateness.delay(), 0);
}

TEST(Lateness, TheTimeToTheSinkDecreasesWithEarlierMaps) {
  Lateness lateness = synchronizing();
  lateness.sent(100 * kMs, 80 * kMs);
  lateness.sink_reported(100 * kMs, 20 * kMs);
  EXPECT_EQ(lateness.delay(), 40 * kMs);
  for (int i = 2; i < 30; ++i) {
    lateness.sent(i * 100 * kMs, i * 100 * kMs - 10 * kMs);
    lateness.sink_reported(i * 100 * kMs, -7 * kMs - i);
  }
  EXPECT_NEAR(static_cast<double>(lateness.delay()), 3.0 * kMs, 0.1 * kMs);
}

TEST(Lateness, AReportOfAnUnknownMapDoesNotChangeTheTimeToTheSink) {
  Lateness lateness = synchronizing();
  lateness.sink_reported(700 * kMs, 500 * kMs);
  EXPECT_EQ(lateness.delay(), 0);
  EXPECT_EQ(lateness.predict(720 * kMs, 700 * kMs, 10 * kMs), -10 * kMs);
}

TEST(Lateness, AMapIsDueAfterALongPauseThoughItIsLate) {
  const Lateness lateness = synchronizing();
  EXPECT_TRUE(lateness.predict(1000 * kMs, 5000 * kMs, 10 * kMs));
  EXPECT_FALSE(lateness.predict(1021 * kMs, 5000 * kMs, 10 * kMs));
  EXPECT_TRUE(lateness.predict(1500 * kMs, 5000 * kMs, 400 * kMs));
}

TEST(Lateness, IsUnknownAfterARestart) {
  Lateness lateness = synchronizing();
  lateness.restart();
  EXPECT_FALSE(lateness.predict(40 * kMs, 1000 * kMs, 10 * kMs));
  lateness.sent(0, 0);
  EXPECT_FALSE(lateness.predict(40 * kMs, 1000 * kMs, 10 * kMs));
}

TEST(Lateness, AMapOfTheSameTimeBeforeARestartDoesNotCount) {
  Lateness lateness = synchronizing();
  lateness.restart();
  lateness.sent(0, -3 * kMs);
  lateness.sink_reported(0, 2 * kMs);
  EXPECT_EQ(lateness.delay(), 5 * kMs);
}

TEST(ProcessingLatency, IgnoresTheFirstPair) {
  ProcessingLatency latency;
  EXPECT_FALSE(latency.measured(900));
  EXPECT_EQ(latency.reported_ms(), 0);
  EXPECT_EQ(latency.expected_ms(), 0);
  EXPECT_TRUE(latency.measured(10));
  EXPECT_NEAR(latency.expected_ms(), 10, 1e-9);
  EXPECT_NEAR(latency.reported_ms(), 10.5, 1e-9);
}

TEST(ProcessingLatency, KeepsTheReportedValueDespiteJitter) {
  ProcessingLatency latency;
  for (int i = 0; i < 20; ++i) latency.measured(i % 2 == 0 ? 8 : 12);
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(latency.measured(i % 2 == 0 ? 8 : 12)) << i;
}

TEST(ProcessingLatency, IsNotShorterThanExpected) {
  ProcessingLatency latency;
  for (int i = 0; i < 300; ++i) {
    latency.measured(10 + i * 0.1 + i * 7 % 5);
    EXPECT_GE(latency.reported_ms(), latency.expected_ms()) << i;
  }
}

TEST(ProcessingLatency, FewPairsTakeLongerThanExpected) {
  ProcessingLatency latency;
  int longer = 0;
  for (int i = 0; i < 1000; ++i) {
    const double time = 40 + i * 37 % 11;
    if (i > 10 && time > latency.expected_ms()) ++longer;
    latency.measured(time);
  }
  EXPECT_LT(longer, 20);
  EXPECT_LT(latency.expected_ms(), 55);
}

TEST(ProcessingLatency, OneSlowPairHasALimitedEffect) {
  ProcessingLatency latency;
  for (int i = 0; i < 20; ++i) latency.measured(10);
  latency.measured(1000);
  EXPECT_LT(latency.expected_ms(), 17);
  for (int i = 0; i < 10; ++i) latency.measured(10);
  EXPECT_LT(latency.expected_ms(), 12);
}

// Feature: latency
TEST(ProcessingLatency, FollowsALastingChange) {
  ProcessingLatency latency;
  latency.measured(10);
  latency.measured(10);
  for (int i = 0; i < 50; ++i) latency.measured(40);
  EXPECT_GT(latency.reported_ms(), 40);
  EXPECT_LT(latency.reported_ms(), 60);
  for (int i = 0; i < 50; ++i) latency.measured(10);
  EXPECT_LT(latency.reported_ms(), 15);
}

}  // namespace
}  // namespace mtstereo::plugin::lateness_test
