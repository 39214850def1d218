// SPDX-License-Identifier: LGPL-2.1-or-later
// The property sync-mode: pairs by other times than the running times.
#include <gtest/gtest.h>

#include <thread>

#include "support/defective_streams.hpp"

namespace mtstereo::test::sync_mode_test {
namespace {

constexpr Nanoseconds kMs = 1'000'000;

FeedOptions with_mode(const std::string& mode) {
  FeedOptions options;
  options.properties = std::string(kNumberedMatching) + " sync-mode=" + mode;
  return options;
}

void expect_all_right(const FeedResult& result, int maps) {
  EXPECT_EQ(result.error, "");
  EXPECT_EQ(result.count.maps, maps) << summary(result);
  EXPECT_EQ(result.count.wrong + result.count.unknown, 0) << summary(result);
  EXPECT_TRUE(result.warnings.empty()) << summary(result);
}

// Feature: pairing by other times than running time
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

// Feature: pairing by other times than running time
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

// Feature: pairing by other times than running time
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

// An RTP depayloader puts the rest of a lost picture, with its time, in front of the next one.
// Feature: truncated frames, and RTP before its first report
TEST(SyncMode, ReferenceTimestampIsTheLatestOfAFrame) {
  auto lefts = with_reference(60, 0, 0, 1);
  auto rights = with_reference(60, 0, 0, 2);
  for (std::size_t i = 10; i < 60; i += 10) {
    lefts[i].earlier_reference = lefts[i - 1].reference;
    rights[i + 3].earlier_reference = rights[i + 2].reference;
  }
  expect_all_right(feed(lefts, rights, with_mode("reference-timestamp")), 60);
}

TEST(SyncMode, ReferenceTimestampPairsInReverse) {
  StereoHarness harness(with_mode("reference-timestamp").properties);
  harness.caps(raw_caps("GRAY8", kNumberedWidth, kNumberedHeight));
  GstSegment segment = time_segment();
  segment.rate = -1, segment.stop = 60 * kFrame;
  harness.segment(segment);
  const CapsPointer clock(gst_caps_from_string("timestamp/x-ntp"));
  const auto push = [&](Side side, int lost) {
    for (int i = 49; i >= 0; --i) {
      const GstClockTime time = static_cast<GstClockTime>(i) * kFrame;
      GstBuffer* frame = numbered_frame(side, i, time);
      gst_buffer_add_reference_timestamp_meta(frame, clock.get(), time, GST_CLOCK_TIME_NONE);
      i % 5 != lost ? static_cast<void>(harness.push(side, frame)) : gst_buffer_unref(frame);
    }
    harness.end(side);
  };
  std::thread left([&] { push(Side::kLeft, 1); });
  push(Side::kRight, 3);
  left.join();
  DifferenceCounter count;
  ASSERT_TRUE(harness.pull_event(GST_EVENT_EOS));
  while (const BufferPointer map = harness.pull(0)) count.add(frame_difference(map.get()));
  EXPECT_EQ(count.wrong + count.unknown, 0);
  EXPECT_EQ(count.maps, 30);
}

// RTP streams have no reference time stamps before the first report of their sender.
// Feature: truncated frames, and RTP before its first report
TEST(SyncMode, ReferenceTimestampDropsLiveFramesWithoutOneAtTheStart) {
  auto lefts = numbered_sequence(60, kFrame / 2);
  auto rights = lefts;
  for (std::size_t i = 0; i < 60; ++i) {
    if (i >= 20) lefts[i].reference = lefts[i].pts;
    if (i >= 10) rights[i].reference = rights[i].pts;
  }
  FeedOptions options = with_mode("reference-timestamp");
  options.live = true;
  options.framerate = "60/1";
  options.duration = kFrame / 2;
  const FeedResult result = feed(lefts, rights, options);
  EXPECT_EQ(result.error, "");
  EXPECT_GT(result.count.maps, 30) << summary(result);
  EXPECT_LE(result.count.maps, 40) << summary(result);
  EXPECT_EQ(result.count.wrong + result.count.unknown, 0) << summary(result);
}

// Feature: truncated frames, and RTP before its first report
TEST(SyncMode, ReferenceTimestampNamesTheLivePadWithoutOneForTenSeconds) {
  auto lefts = numbered_sequence(60);
  auto rights = numbered_sequence(60);
  for (std::size_t i = 0; i < 60; ++i) {
    lefts[i].reference = lefts[i].pts;
    if (i < 20) continue;
    for (NumberedFrame* frame : {&lefts[i], &rights[i]}) {
      frame->arrival = frame->pts;
      frame->pts += 11 * GST_SECOND;
    }
  }
  FeedOptions options = with_mode("reference-timestamp");
  options.live = true;
  const FeedResult result = feed(lefts, rights, options);
  EXPECT_NE(result.error.find("A frame of sink_right"), std::string::npos) << result.error;
  EXPECT_EQ(result.count.maps, 0);
}

}  // namespace
}  // namespace mtstereo::test::sync_mode_test
