// SPDX-License-Identifier: LGPL-2.1-or-later
// The frames that the element pairs and drops, and its statistics.
#include <gtest/gtest.h>

#include <random>

#include "support/fixtures.hpp"

namespace mtstereo::test::pair_order_test {
namespace {

class PairOrder : public StreamsTest {
 protected:
  /// The time stamps of all maps until the end of the stream.
  std::vector<GstClockTime> times_until_end() {
    EXPECT_TRUE(harness->pull_event(GST_EVENT_EOS)) << "no end of stream";
    std::vector<GstClockTime> times;
    while (BufferPointer buffer = harness->pull(0)) times.push_back(GST_BUFFER_PTS(buffer.get()));
    return times;
  }
  /// The time stamps of all maps of two streams.
  std::vector<GstClockTime> times_of(const std::vector<GstClockTime>& lefts,
                                     const std::vector<GstClockTime>& rights) {
    Feeder first(*harness, Side::kLeft, pair, lefts);
    Feeder second(*harness, Side::kRight, pair, rights);
    return times_until_end();
  }
};

TEST_F(PairOrder, OutputsEveryPairOnceInOrder) {
  start();
  for (GstClockTime i = 0; i < 10; ++i) {
    harness->push_pair(pair, i * kFrame);
    const BufferPointer map = harness->pull();
    ASSERT_TRUE(map) << "pair " << i;
    EXPECT_EQ(GST_BUFFER_PTS(map.get()), i * kFrame);
  }
  EXPECT_TRUE(harness->silent());
  EXPECT_EQ(harness->stats().pairs, 10u);
}

TEST_F(PairOrder, WaitsForBothFrames) {
  start();
  left(0);
  EXPECT_TRUE(harness->silent());
  right(0);
  EXPECT_TRUE(harness->pull());
}

// Feature: frames without a partner are counted and reported
TEST_F(PairOrder, DropsAndCountsFramesWithoutPartners) {
  for (const Side alone : {Side::kLeft, Side::kRight}) {
    start();
    push(alone, 0);
    push(alone == Side::kLeft ? Side::kRight : Side::kLeft, kFrame);
    push(alone, kFrame);
    expect_map_at(kFrame);
    EXPECT_TRUE(harness->wait_for_stats(1, alone == Side::kLeft, alone == Side::kRight));
  }
}

TEST_F(PairOrder, PairsFramesLessThanHalfAFrameDurationApart) {
  for (const bool before : {false, true}) {
    start();
    std::vector<GstClockTime> lefts;
    std::vector<GstClockTime> rights;
    for (GstClockTime i = 1; i <= 10; ++i) {
      lefts.push_back(i * kFrame);
      rights.push_back(before ? i * kFrame - kFrame / 2 + 1 : i * kFrame + kFrame / 2 - 1);
    }
    EXPECT_EQ(times_of(lefts, rights), lefts) << "the time stamps of the left frames";
  }
}

// Feature: pairs by running time, with a tolerance
TEST_F(PairOrder, UsesTheToleranceThatIsSet) {
  start("max-disparity=16 sync-tolerance=1000000");
  left(0);
  right(1'000'001);
  EXPECT_TRUE(harness->wait_for_stats(0, 1, 0));
  left(2'000'001);
  EXPECT_TRUE(harness->pull());
}

TEST_F(PairOrder, ToleranceCanBeChangedWhilePlaying) {
  start("max-disparity=16 sync-tolerance=0");
  left(0);
  right(1);
  EXPECT_TRUE(harness->wait_for_stats(0, 1, 0));
  g_object_set(harness->element(), "sync-tolerance", gint64{2000}, nullptr);
  left(1000);
  EXPECT_TRUE(harness->pull());
}

TEST_F(PairOrder, PairsADelayedStreamFromItsStart) {
  start();
  std::vector<GstClockTime> early;
  std::vector<GstClockTime> late;
  for (GstClockTime i = 0; i < 12; ++i) early.push_back(i * kFrame);
  for (GstClockTime i = 5; i < 12; ++i) late.push_back(i * kFrame);
  EXPECT_EQ(times_of(early, late), late);
  EXPECT_EQ(harness->stats().dropped_left, 5u);
  EXPECT_EQ(harness->stats().dropped_right, 0u);
}

TEST_F(PairOrder, LosesOnlyThePairsOfLostFrames) {
  start();
  std::vector<GstClockTime> lefts;
  std::vector<GstClockTime> rights;
  std::vector<GstClockTime> both;
  for (GstClockTime i = 0; i < 30; ++i) {
    const bool lost_left = i % 7 == 3;
    const bool lost_right = i % 5 == 2;
    if (!lost_left) lefts.push_back(i * kFrame);
    if (!lost_right) rights.push_back(i * kFrame);
    if (!lost_left && !lost_right) both.push_back(i * kFrame);
  }
  EXPECT_EQ(times_of(lefts, rights), both);
  EXPECT_EQ(harness->stats().pairs, both.size());
  EXPECT_EQ(harness->stats().dropped_left, lefts.size() - both.size());
  EXPECT_EQ(harness->stats().dropped_right, rights.size() - both.size());
}

// Feature: the streams may differ in framerate and other caps
TEST_F(PairOrder, PairsStreamsOfDifferentFrameratesAtTheLowerOne) {
  start();
  harness->caps(Side::kLeft, raw_caps("GRAY8", kWidth, kHeight, "15/1"));
  std::vector<GstClockTime> slow;
  std::vector<GstClockTime> fast;
  for (GstClockTime i = 0; i < 19; ++i) {  // the last frame has a partner
    const GstClockTime time = gst_util_uint64_scale_int(GST_SECOND, static_cast<gint>(i), 30);
    fast.push_back(time);
    if (i % 2 == 0) slow.push_back(time);
  }
  EXPECT_EQ(times_of(slow, fast), slow);
  EXPECT_EQ(harness->stats().dropped_left, 0u);
  EXPECT_EQ(harness->stats().dropped_right, 9u);
}

// Feature: pairing by other times than running time
TEST_F(PairOrder, PairsFramesWithoutTimeStampsInOrder) {
  start();
  for (int i = 0; i < 3; ++i) {
    harness->push_pair(pair, GST_CLOCK_TIME_NONE);
    const BufferPointer map = harness->pull();
    ASSERT_TRUE(map) << i;
    EXPECT_FALSE(GST_BUFFER_PTS_IS_VALID(map.get()));
  }
}

TEST_F(PairOrder, ReportsTimeStampsOnOneSideOnly) {
  start();
  left(0);
  right(GST_CLOCK_TIME_NONE);
  const Report error = harness->error();
  EXPECT_NE(error.text.find("sink_left have time stamps"), std::string::npos) << error.text;
  EXPECT_NE(error.text.find("sink_right do not"), std::string::npos) << error.text;
  EXPECT_EQ(harness->further_errors(), 0);
}

// Feature: correction of a constant skew
TEST_F(PairOrder, PadOffsetDelaysAStream) {
  harness = std::make_unique<StereoHarness>("max-disparity=16");
  // As on the command line: mtstereo sink_right::offset=1000000000
  gst_child_proxy_set(GST_CHILD_PROXY(harness->element()), "sink_right::offset",
                      static_cast<gint64>(GST_SECOND), nullptr);
  harness->caps(raw_caps("GRAY8", kWidth, kHeight));
  left(GST_SECOND);
  right(0);
  EXPECT_TRUE(harness->pull());
  EXPECT_TRUE(harness->wait_for_stats(1, 0, 0));
}

TEST_F(PairOrder, ComparesRunningTimes) {
  start();
  GstSegment segment = time_segment();
  segment.start = 100 * GST_SECOND;
  segment.time = 100 * GST_SECOND;
  harness->event(Side::kRight, gst_event_new_segment(&segment));
  left(2 * kFrame);
  right(100 * GST_SECOND + 2 * kFrame);
  EXPECT_TRUE(harness->pull());
}

TEST_F(PairOrder, DropsFramesOutsideTheirSegment) {
  start();
  GstSegment segment = time_segment();
  segment.start = GST_SECOND;
  harness->segment(segment);
  harness->push_pair(pair, 0);
  harness->push_pair(pair, GST_SECOND);
  expect_map_at(GST_SECOND);
  EXPECT_TRUE(harness->wait_for_stats(1, 0, 0));
}

// Feature: frames without a partner are counted and reported
TEST_F(PairOrder, WarnsOnceIfNoFramesPair) {
  start("max-disparity=16 sync-tolerance=1000000");
  std::vector<GstClockTime> lefts;
  std::vector<GstClockTime> rights;
  for (GstClockTime i = 0; i < 40; ++i) {
    lefts.push_back(i * kFrame);
    rights.push_back(i * kFrame + 9'000'000);
  }
  EXPECT_TRUE(times_of(lefts, rights).empty());
  const Report warning = harness->warning();
  EXPECT_NE(warning.text.find("sync-tolerance"), std::string::npos) << warning.text;
  EXPECT_NE(warning.text.find("1.000 ms"), std::string::npos) << warning.text;
  EXPECT_NE(warning.details.find("ms after the left frame"), std::string::npos) << warning.details;
  EXPECT_EQ(harness->warning(0.1).text, "");
}

TEST_F(PairOrder, DoesNotDependOnTheOrderOfArrival) {
  std::vector<Pair> pairs;
  for (unsigned i = 0; i < 8; ++i) pairs.push_back(noise_pair(kWidth, kHeight, 4, i));
  std::vector<std::vector<std::uint16_t>> expected;
  for (unsigned seed = 0; seed < 4; ++seed) {
    start();
    std::mt19937 random(seed);
    std::size_t next[2] = {0, 0};
    std::vector<std::vector<std::uint16_t>> maps;
    while (maps.size() < pairs.size()) {
      // A pad holds one frame, so one side can be at most one frame ahead of the other.
      const std::size_t side = next[0] > next[1] ? 1 : next[1] > next[0] ? 0 : random() % 2;
      const Pair& current = pairs[next[side]];
      const GstClockTime time = next[side]++ * kFrame;
      harness->push(side == 0 ? Side::kLeft : Side::kRight,
                    frame_buffer(side == 0 ? current.left : current.right, time, kFrame));
      if (next[0] != next[1]) continue;
      const BufferPointer map = harness->pull();
      ASSERT_TRUE(map) << "seed " << seed;
      maps.push_back(map_of(map.get(), kWidth, kHeight));
    }
    if (seed == 0) expected = maps;
    for (std::size_t i = 0; i < maps.size(); ++i) {
      EXPECT_EQ(first_difference(expected[i], maps[i], kWidth), "")
          << "seed " << seed << " pair " << i;
    }
  }
}

}  // namespace
}  // namespace mtstereo::test::pair_order_test
