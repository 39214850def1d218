// SPDX-License-Identifier: LGPL-2.1-or-later
// Live streams: deadlines, latency and quality of service, by a test clock.
#include <gtest/gtest.h>

#include <thread>

#include "support/fixtures.hpp"

namespace mtstereo::test::live_test {
namespace {

class Live : public StreamsTest {
 protected:
  void start(bool live, const std::string& properties = "max-disparity=16") {
    StreamsTest::start(properties, live);
  }
  /// Matches the first pair. Then it is the time of the fourth.
  void fall_behind() {
    ASSERT_TRUE(next());
    gst_harness_set_time(harness->output(), 3 * kFrame);
  }
  /// The next pair, which is late, is matched.
  void expect_match(const char* why = "") {
    harness->push_pair(pair, kFrame);
    EXPECT_TRUE(harness->pull()) << why;
    EXPECT_EQ(harness->stats().skipped, 0u);
  }
  /// The sink reports the lateness of the first map.
  void report_from_sink(GstClockTimeDiff jitter, GstQOSType type = GST_QOS_TYPE_UNDERFLOW) {
    gst_harness_push_upstream_event(harness->output(), gst_event_new_qos(type, 1.0, jitter, 0));
  }
  /// Advances the clock to the end of the only wait of the element.
  bool pass_deadline() { return gst_harness_crank_single_clock_wait(harness->output()); }
  GstClockTime latency() { return gst_harness_query_latency(harness->output()); }
};

TEST_F(Live, PairsFramesThatArriveInTime) {
  start(true);
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(next()) << i;
}

// Feature: live: a lost frame never blocks
TEST_F(Live, DropsAnUnpairedLeftFrameAtTheDeadlineAndSendsAGap) {
  start(true);
  ASSERT_TRUE(next());
  left(kFrame);
  EXPECT_TRUE(harness->silent()) << "before the deadline";
  ASSERT_TRUE(pass_deadline());
  EXPECT_TRUE(harness->wait_for_stats(1, 1, 0));
  const EventPointer gap = harness->pull_event(GST_EVENT_GAP);
  ASSERT_TRUE(gap);
  GstClockTime time = 0;
  gst_event_parse_gap(gap.get(), &time, nullptr);
  EXPECT_EQ(time, kFrame);
}

// Feature: live: a lost frame never blocks
TEST_F(Live, DropsAnUnpairedRightFrameAtTheDeadlineAndSendsAGap) {
  start(true);
  ASSERT_TRUE(next());
  right(kFrame);
  ASSERT_TRUE(pass_deadline());
  EXPECT_TRUE(harness->wait_for_stats(1, 0, 1));
  EXPECT_TRUE(harness->pull_event(GST_EVENT_GAP));
}

// Feature: live: a lost frame never blocks
TEST_F(Live, ContinuesAfterTheOutageOfACamera) {
  start(true);
  ASSERT_TRUE(next());
  for (GstClockTime i = 1; i <= 5; ++i) {
    left(i * kFrame);
    ASSERT_TRUE(pass_deadline()) << i;
    ASSERT_TRUE(harness->wait_for_stats(1, i, 0)) << i;
  }
  harness->push_pair(pair, 6 * kFrame);
  expect_map_at(6 * kFrame);
}

TEST_F(Live, WarnsIfACameraStopsSending) {
  start(true);
  ASSERT_TRUE(next());
  for (GstClockTime i = 1; i <= 30; ++i) {
    left(i * kFrame);
    ASSERT_TRUE(pass_deadline()) << i;
    ASSERT_TRUE(harness->wait_for_stats(1, i, 0)) << i;
  }
  const Report warning = harness->warning();
  EXPECT_NE(warning.text.find("sink_right"), std::string::npos) << warning.text;
  EXPECT_NE(warning.text.find("latency"), std::string::npos) << warning.text;
}

TEST_F(Live, NamesTimeStampsThatAreFarBehindTheClock) {
  start(true);
  ASSERT_TRUE(next());
  gst_harness_set_time(harness->output(), 60 * GST_SECOND);
  for (GstClockTime i = 1; i <= 30; ++i) {  // such as times in microseconds
    right(i * kFrame);
    ASSERT_TRUE(pass_deadline()) << i;
    ASSERT_TRUE(harness->wait_for_stats(1, 0, i)) << i;
  }
  const Report warning = harness->warning();
  EXPECT_NE(warning.text.find("of sink_right are 59"), std::string::npos) << warning.text;
  EXPECT_NE(warning.text.find("do-timestamp=true"), std::string::npos) << warning.text;
}

/// The warning after 40 pairs, the first of which is 2 s late and each one later by `growth`.
class LatePairs : public Live {
 protected:
  std::vector<Report> warnings_of(GstClockTime growth) {
    start(true);
    EXPECT_TRUE(next());
    for (GstClockTime i = 1; i <= 40; ++i) {
      gst_harness_set_time(harness->output(), 2 * GST_SECOND + i * (kFrame + growth));
      EXPECT_TRUE(next()) << i;
    }
    return harness->warnings();
  }
};

TEST_F(LatePairs, ThatGetEverLaterAreReportedWithTheRemedy) {
  const std::vector<Report> warnings = warnings_of(kFrame);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].text.find("slower than the streams"), std::string::npos)
      << warnings[0].text;
  EXPECT_NE(warnings[0].text.find("newest-pair=true"), std::string::npos) << warnings[0].text;
}

TEST_F(LatePairs, OfConstantLatenessAreNotReported) { EXPECT_TRUE(warnings_of(0).empty()); }

TEST_F(Live, DoesNotWarnOfMissingFramesBetweenPairs) {
  start(true);
  GstClockTime time = 0;
  for (GstClockTime drops = 1; drops <= 40; ++drops) {
    left(++time * kFrame);
    ASSERT_TRUE(pass_deadline()) << time;
    ASSERT_TRUE(harness->wait_for_stats(drops / 20, drops, 0)) << time;
    if (drops % 20 != 19) continue;
    harness->push_pair(pair, ++time * kFrame);
    ASSERT_TRUE(harness->pull());
  }
  EXPECT_TRUE(harness->warnings().empty());
}

TEST_F(Live, WarnsOfTimeStampsThatStandStill) {
  start(true);
  for (int i = 0; i < 11; ++i) {
    harness->push_pair(pair, kFrame);
    ASSERT_TRUE(harness->pull());
  }
  EXPECT_TRUE(harness->warnings().empty());
  left(kFrame);
  ASSERT_TRUE(pass_deadline());
  const Report warning = harness->warning();
  EXPECT_NE(warning.text.find("the last 11 pairs have the same"), std::string::npos)
      << warning.text;
}

TEST_F(Live, WarnsOfTimeStampsForWhichSinksWouldWaitForHours) {
  start(true);
  harness->push_pair(pair, 10000 * GST_SECOND);
  EXPECT_TRUE(harness->pull());
  const Report warning = harness->warning();
  EXPECT_NE(warning.text.find("10000 s ahead of the clock"), std::string::npos) << warning.text;
  EXPECT_NE(warning.text.find("sync=false"), std::string::npos) << warning.text;
}

TEST_F(Live, NamesFirstPtsIfTheStreamsCountFromDifferentStarts) {
  start(false);
  std::thread rights([&] {
    for (GstClockTime i = 0; i < 4; ++i) right(5 * GST_SECOND + i * kFrame);
  });
  for (GstClockTime i = 0; i < 34; ++i) left(i * kFrame);
  const Report warning = harness->warning();
  EXPECT_NE(warning.text.find("s apart"), std::string::npos) << warning.text;
  EXPECT_NE(warning.text.find("first-pts"), std::string::npos) << warning.text;
  harness->event(Side::kRight, gst_event_new_flush_start());  // ends the wait of the last frame
  rights.join();
}

TEST_F(Live, NamesTheJitterOfTimeStampsThatProveNothing) {
  start(false);
  for (GstClockTime i = 1; i <= 40; ++i) {
    left(i * kFrame);
    right(i * kFrame + 18 * GST_MSECOND * (i % 2) - 9 * GST_MSECOND);
  }
  const Report warning = harness->warning();
  EXPECT_NE(warning.text.find("varies by"), std::string::npos) << warning.text;
}

TEST_F(Live, FramesWithoutTimeStampsWaitForTheirPartners) {
  start(true);
  left(GST_CLOCK_TIME_NONE);
  EXPECT_TRUE(harness->silent());
  right(GST_CLOCK_TIME_NONE);
  EXPECT_TRUE(harness->pull());
}

// Feature: files: complete and reproducible
TEST_F(Live, StreamsThatAreNotLiveHaveNoDeadline) {
  start(false);
  left(0);
  gst_harness_set_time(harness->output(), 1000 * GST_SECOND);
  EXPECT_TRUE(harness->silent());
  right(0);
  EXPECT_TRUE(harness->pull());
  EXPECT_TRUE(harness->wait_for_stats(1, 0, 0));
}

// Feature: latency
TEST_F(Live, LatencyIncludesTheWaitForAPartner) {
  start(true);
  gst_harness_set_upstream_latency(harness->side(Side::kLeft), 10 * GST_MSECOND);
  gst_harness_set_upstream_latency(harness->side(Side::kRight), 10 * GST_MSECOND);
  ASSERT_TRUE(next());
  EXPECT_NEAR(static_cast<double>(latency()), static_cast<double>(10 * GST_MSECOND + kFrame), 10.0);
}

TEST_F(Live, LatencyIncludesALargeTolerance) {
  start(true, "max-disparity=16 sync-tolerance=100000000");
  ASSERT_TRUE(next());
  EXPECT_EQ(latency(), 100 * GST_MSECOND);
}

// Feature: latency
TEST_F(Live, LatencyIncludesTheMatchingTime) {
  start(true);
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(next());
  EXPECT_GT(latency(), kFrame + 1000) << "the matching time is missing";
  EXPECT_LT(latency(), kFrame + 10 * GST_SECOND);
  EXPECT_GT(harness->stats().mean_ms, 0.0);
}

// Feature: QoS
TEST_F(Live, SkipsPairsThatWouldBeLateAtASinkThatSynchronizes) {
  start(true);
  fall_behind();
  report_from_sink(1);
  harness->push_pair(pair, kFrame);
  harness->push_pair(pair, 4 * kFrame);
  expect_map_at(4 * kFrame);
  EXPECT_EQ(harness->stats().skipped, 1u);
  EXPECT_EQ(harness->stats().pairs, 2u);
  const MessagePointer message(
      gst_bus_timed_pop_filtered(GST_ELEMENT_BUS(harness->element()), GST_SECOND, GST_MESSAGE_QOS));
  ASSERT_TRUE(message);
  guint64 processed = 0;
  guint64 dropped = 0;
  gst_message_parse_qos_stats(message.get(), nullptr, &processed, &dropped);
  EXPECT_EQ(processed, 1u);
  EXPECT_EQ(dropped, 1u);
  gint64 jitter = 0;
  gst_message_parse_qos_values(message.get(), &jitter, nullptr, nullptr);
  EXPECT_EQ(jitter, static_cast<gint64>(2 * kFrame + 1)) << "by the clock";
  gst_element_set_state(harness->element(), GST_STATE_READY);
  gst_element_set_state(harness->element(), GST_STATE_PAUSED);
  EXPECT_EQ(harness->stats().skipped, 0u) << "when it starts again";
}

TEST_F(Live, SkipsLatePairsOfStreamsThatAreNotLiveToo) {
  start(false);
  fall_behind();
  report_from_sink(1);
  harness->push_pair(pair, kFrame);
  harness->push_pair(pair, 4 * kFrame);
  expect_map_at(4 * kFrame);
}

TEST_F(Live, MatchesLatePairsIfTheSinkDoesNotSynchronize) {
  start(true);
  fall_behind();
  report_from_sink(0);
  expect_match();
}

TEST_F(Live, MatchesLatePairsIfThrottlingIsAllThatTheSinkReports) {
  start(true);
  fall_behind();
  report_from_sink(kFrame, GST_QOS_TYPE_THROTTLE);
  expect_match();
}

// Feature: QoS
TEST_F(Live, MatchesLatePairsIfQosIsDisabled) {
  start(true, "max-disparity=16 qos=false");
  fall_behind();
  report_from_sink(1);
  expect_match();
}

TEST_F(Live, MatchesLatePairsInPaused) {
  start(true);
  fall_behind();
  report_from_sink(1);
  gst_element_set_state(harness->element(), GST_STATE_PAUSED);
  expect_match("the clock does not count before PLAYING");
}

TEST_F(Live, ALatePairIsMatchedAfterAPauseOfOneSecond) {
  start(true);
  ASSERT_TRUE(next());
  gst_harness_set_time(harness->output(), 100 * GST_SECOND);
  report_from_sink(1);
  for (GstClockTime time = kFrame; time <= GST_SECOND; time += kFrame) {
    harness->push_pair(pair, time);
  }
  harness->push_pair(pair, 2 * GST_SECOND);
  expect_map_at(2 * GST_SECOND);
  EXPECT_EQ(harness->stats().skipped, 30u);
}

TEST_F(Live, AFlushForgetsThatTheSinkSynchronizes) {
  start(true);
  fall_behind();
  report_from_sink(1);
  harness->flush(7);
  expect_match("the sink has to preroll");
}

TEST_F(Live, ANewSegmentForgetsThatTheSinkSynchronizes) {
  start(true);
  fall_behind();
  report_from_sink(1);
  GstSegment segment = time_segment();
  segment.start = kFrame;  // running times start over
  harness->segment(segment);
  expect_match();
}

TEST_F(Live, TheLatencyOfThePipelineIsNotLateness) {
  start(true);
  ASSERT_TRUE(next());
  gst_harness_push_upstream_event(harness->output(), gst_event_new_latency(5 * GST_SECOND));
  gst_harness_set_time(harness->output(), 3 * kFrame);
  report_from_sink(1);
  expect_match();
}

TEST_F(Live, AddsTheMatchingTimeToTheLateness) {
  start(true);
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(next());
  // A map of 3 frames would be in time now, but not after the time to match it.
  gst_harness_set_time(harness->output(), 3 * kFrame - 1000);
  report_from_sink(1);
  harness->push_pair(pair, 3 * kFrame);
  harness->push_pair(pair, 20 * kFrame);
  expect_map_at(20 * kFrame);
  EXPECT_EQ(harness->stats().skipped, 1u);
}

TEST_F(Live, ALateFrameHasAGracePeriod) {
  start(true);
  ASSERT_TRUE(next());
  gst_harness_set_time(harness->output(), 10 * GST_SECOND);
  left(kFrame);  // late by seconds, as after a long matching time
  EXPECT_TRUE(harness->silent());
  EXPECT_EQ(harness->stats().dropped_left, 0u);
  right(kFrame);
  EXPECT_TRUE(harness->pull());
  left(2 * kFrame);
  ASSERT_TRUE(pass_deadline());
  EXPECT_TRUE(harness->wait_for_stats(2, 1, 0)) << "the grace period must end";
}

TEST_F(Live, DoesNotForwardQosEventsIfQosIsDisabled) {
  start(true, "max-disparity=16 qos=false");
  ASSERT_TRUE(next());
  gst_harness_push_upstream_event(harness->output(),
                                  gst_event_new_qos(GST_QOS_TYPE_UNDERFLOW, 2.0, 0, kFrame));
  for (const Side side : {Side::kLeft, Side::kRight}) {
    while (EventPointer event{gst_harness_try_pull_upstream_event(harness->side(side))}) {
      EXPECT_NE(GST_EVENT_TYPE(event.get()), GST_EVENT_QOS);
    }
  }
}

TEST_F(Live, ForwardsQosEventsToBothSources) {
  start(true);
  ASSERT_TRUE(next());
  gst_harness_push_upstream_event(harness->output(),
                                  gst_event_new_qos(GST_QOS_TYPE_UNDERFLOW, 2.0, 0, kFrame));
  for (const Side side : {Side::kLeft, Side::kRight}) {
    bool seen = false;
    while (EventPointer event{gst_harness_try_pull_upstream_event(harness->side(side))}) {
      seen = seen || GST_EVENT_TYPE(event.get()) == GST_EVENT_QOS;
    }
    EXPECT_TRUE(seen);
  }
}

}  // namespace
}  // namespace mtstereo::test::live_test
