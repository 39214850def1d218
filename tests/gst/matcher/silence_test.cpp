// SPDX-License-Identifier: LGPL-2.1-or-later
// When a stream counts as silent.
#include "matcher/silence.hpp"

#include <gtest/gtest.h>

namespace mtstereo::plugin::silence_test {
namespace {

constexpr Nanoseconds kTimeout = 100;

StreamsObservation left_waits() {
  StreamsObservation streams;
  streams.waiting = {true, false};
  return streams;
}

TEST(Silence, IsReportedAfterTheTimeout) {
  SilenceDetector detector;
  EXPECT_EQ(detector.silent(left_waits(), 1000, kTimeout), std::nullopt);
  EXPECT_EQ(detector.silent(left_waits(), 1099, kTimeout), std::nullopt);
  EXPECT_EQ(detector.silent(left_waits(), 1100, kTimeout), Side::kRight);
}

TEST(Silence, OfTheLeftStreamIsReported) {
  SilenceDetector detector;
  StreamsObservation streams;
  streams.waiting = {false, true};
  detector.silent(streams, 0, kTimeout);
  EXPECT_EQ(detector.silent(streams, 100, kTimeout), Side::kLeft);
}

TEST(Silence, IsReportedOnce) {
  SilenceDetector detector;
  detector.silent(left_waits(), 0, kTimeout);
  EXPECT_TRUE(detector.silent(left_waits(), 100, kTimeout));
  for (Nanoseconds now = 200; now < 2000; now += 100) {
    EXPECT_FALSE(detector.silent(left_waits(), now, kTimeout)) << now;
  }
}

TEST(Silence, IsReportedAgainAfterFramesHaveArrived) {
  SilenceDetector detector;
  detector.silent(left_waits(), 0, kTimeout);
  EXPECT_TRUE(detector.silent(left_waits(), 100, kTimeout));
  detector.silent({}, 200, kTimeout);
  EXPECT_FALSE(detector.silent(left_waits(), 300, kTimeout));
  EXPECT_TRUE(detector.silent(left_waits(), 400, kTimeout));
}

TEST(Silence, StartsAgainIfFramesWereConsumedBetweenTwoObservations) {
  SilenceDetector detector;
  StreamsObservation streams = left_waits();
  for (Nanoseconds now = 0; now < 2000; now += 90) {
    ++streams.progress;
    EXPECT_FALSE(detector.silent(streams, now, kTimeout)) << now;
  }
}

TEST(Silence, NeedsFramesThatWait) {
  SilenceDetector detector;
  StreamsObservation streams;
  for (const bool waiting : {false, true}) {
    streams.waiting = {waiting, waiting};
    detector.silent(streams, 0, kTimeout);
    EXPECT_FALSE(detector.silent(streams, 1000, kTimeout));
  }
}

TEST(Silence, AStreamThatHasEndedIsNotSilent) {
  SilenceDetector detector;
  StreamsObservation streams = left_waits();
  streams.ended = {false, true};
  detector.silent(streams, 0, kTimeout);
  EXPECT_FALSE(detector.silent(streams, 1000, kTimeout));
  streams.ended = {true, false};
  detector.silent(streams, 2000, kTimeout);
  EXPECT_EQ(detector.silent(streams, 3000, kTimeout), Side::kRight) << "the other one may end";
}

TEST(Silence, IsNotCountedWhileTheElementIsBusy) {
  SilenceDetector detector;
  StreamsObservation streams = left_waits();
  detector.silent(streams, 0, kTimeout);
  streams.busy = true;
  EXPECT_FALSE(detector.silent(streams, 1000, kTimeout));
  streams.busy = false;
  EXPECT_FALSE(detector.silent(streams, 1010, kTimeout));
  EXPECT_TRUE(detector.silent(streams, 1110, kTimeout));
}

TEST(LongWait, IsDueOnceAfterTheTimeout) {
  LongWait wait;
  EXPECT_FALSE(wait.due(true, 1000, kTimeout));
  EXPECT_FALSE(wait.due(true, 1099, kTimeout));
  EXPECT_TRUE(wait.due(true, 1100, kTimeout));
  EXPECT_FALSE(wait.due(true, 2000, kTimeout));
}

TEST(LongWait, StartsOverAfterAnInterruption) {
  LongWait wait;
  EXPECT_FALSE(wait.due(false, 0, kTimeout));
  EXPECT_FALSE(wait.due(true, 1000, kTimeout));
  EXPECT_FALSE(wait.due(false, 1090, kTimeout));
  EXPECT_FALSE(wait.due(true, 1100, kTimeout));
  EXPECT_TRUE(wait.due(true, 1200, kTimeout));
}

}  // namespace
}  // namespace mtstereo::plugin::silence_test
