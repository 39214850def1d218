// SPDX-License-Identifier: LGPL-2.1-or-later
// Gaps of one stream while one thread feeds both pads, as a demuxer does; segments and the end of
// the stream.
#include <gst/app/gstappsrc.h>
#include <gtest/gtest.h>

#include <chrono>
#include <future>

#include "support/numbered_views.hpp"
#include "support/pipeline.hpp"
#include "support/stereo_harness.hpp"

namespace mtstereo::test::gap_test {
namespace {

constexpr int kBefore = 10;  // pairs before a gap
constexpr int kAfter = 10;   // pairs after it

/// How a gap is announced.
enum class Announcement { kOnce, kPerFrame, kWithoutDuration };

class Gaps : public testing::TestWithParam<Side> {
 protected:
  Gaps() { harness.caps(raw_caps("GRAY8", kNumberedWidth, kNumberedHeight)); }

  static GstClockTime time_of(int frame) { return static_cast<GstClockTime>(frame) * kFrame; }
  void push(Side side, int frame) {
    harness.push(side, numbered_frame(side, frame, time_of(frame)));
  }
  void announce(Announcement kind, int frame, int first, int length) {
    const Side side = GetParam();
    if (kind == Announcement::kOnce && frame == first) {
      harness.event(side, gst_event_new_gap(time_of(first), time_of(length)));
    } else if (kind == Announcement::kPerFrame) {
      harness.event(side, gst_event_new_gap(time_of(frame), kFrame));
    } else if (kind == Announcement::kWithoutDuration) {
      harness.event(side, gst_event_new_gap(time_of(frame), GST_CLOCK_TIME_NONE));
    }
  }
  /// Pushes the frames of both sides in the order of their times.
  void push_all(Announcement kind, int first, int length) {
    for (int frame = 0; frame < first + length + kAfter; ++frame) {
      for (const Side side : {Side::kLeft, Side::kRight}) {
        if (side == GetParam() && frame >= first && frame < first + length) {
          announce(kind, frame, first, length);
        } else {
          push(side, frame);
        }
      }
    }
    for (const Side side : {Side::kLeft, Side::kRight}) harness.end(side);
  }
  /// The same in a thread. False if it hangs.
  bool completes(Announcement kind, int first, int length) {
    auto done = std::async(std::launch::async, [&] { push_all(kind, first, length); });
    const bool in_time = done.wait_for(std::chrono::seconds(20)) == std::future_status::ready;
    // Releases a push that blocks.
    if (!in_time) gst_element_set_state(harness.element(), GST_STATE_NULL);
    done.wait();
    return in_time;
  }
  void expect_maps(int count) {
    ASSERT_TRUE(harness.pull_event(GST_EVENT_EOS));
    DifferenceCounter counter;
    while (BufferPointer map = harness.pull(0)) counter.add(frame_difference(map.get()));
    EXPECT_EQ(counter.maps, count);
    EXPECT_EQ(counter.wrong + counter.unknown, 0);
  }

  StereoHarness harness{"max-disparity=64"};
};

class GapsOfLength : public Gaps {
 protected:
  void check(Announcement kind) {
    for (const int length : {0, 1, 3, 15, 30, 90}) {
      SCOPED_TRACE("gap of " + std::to_string(length) + " frames");
      ASSERT_TRUE(completes(kind, kBefore, length));
      expect_maps(kBefore + kAfter);
      harness.flush(gst_util_seqnum_next());
    }
  }
};

// Feature: gaps and flags
TEST_P(GapsOfLength, AnnouncedOnceDoNotBlock) { check(Announcement::kOnce); }
TEST_P(GapsOfLength, AnnouncedPerFrameDoNotBlock) { check(Announcement::kPerFrame); }

TEST_P(Gaps, WithoutADurationDoNotBlockAtTheirTime) {
  EXPECT_TRUE(completes(Announcement::kWithoutDuration, kBefore, 1));
  expect_maps(kBefore + kAfter);
}

TEST_P(Gaps, AtTheStartDoNotBlock) {
  EXPECT_TRUE(completes(Announcement::kOnce, 0, 30));
  expect_maps(kAfter);
}

GstPadProbeReturn count_segment(GstPad*, GstPadProbeInfo* info, gpointer count) {
  if (GST_EVENT_TYPE(GST_PAD_PROBE_INFO_EVENT(info)) == GST_EVENT_SEGMENT) {
    ++*static_cast<int*>(count);
  }
  return GST_PAD_PROBE_OK;
}

/// Counts the segments that arrive at the sink.
void count_segments(const StereoHarness& harness, int* count) {
  gst_pad_add_probe(harness.output()->sinkpad, GST_PAD_PROBE_TYPE_EVENT_DOWNSTREAM, count_segment,
                    count, nullptr);
}

TEST_P(Gaps, AtTheStartSendTheSegmentOnce) {
  int segments = 0;
  count_segments(harness, &segments);
  EXPECT_TRUE(completes(Announcement::kPerFrame, 0, 5));
  expect_maps(kAfter);
  EXPECT_EQ(segments, 1);
}

TEST_P(Gaps, AfterAFlushSendTheSegmentOnce) {
  int segments = 0;
  count_segments(harness, &segments);
  for (int i = 1; i <= 3; ++i) {
    EXPECT_TRUE(completes(Announcement::kPerFrame, 0, 5));
    expect_maps(kAfter);
    EXPECT_EQ(segments, i) << "a segment after each flush";
    harness.flush(gst_util_seqnum_next());
  }
}

INSTANTIATE_TEST_SUITE_P(Sides, Gaps, testing::Values(Side::kLeft, Side::kRight),
                         [](const auto& info) {
                           return info.param == Side::kLeft ? "Left" : "Right";
                         });
INSTANTIATE_TEST_SUITE_P(Sides, GapsOfLength, testing::Values(Side::kLeft, Side::kRight),
                         [](const auto& info) {
                           return info.param == Side::kLeft ? "Left" : "Right";
                         });

TEST(Segments, WithoutAPairEndWithTheNumberOfTheSeek) {
  StereoHarness harness;
  harness.caps(raw_caps("GRAY8", 64, 48));
  harness.push_pair(noise_pair(64, 48, 4, 1), 0);
  EXPECT_TRUE(harness.pull());
  const guint32 seek = gst_util_seqnum_next();
  harness.flush(seek);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    GstEvent* const end = gst_event_new_eos();
    gst_event_set_seqnum(end, seek);
    harness.event(side, end);
  }
  const EventPointer end = harness.pull_event(GST_EVENT_EOS);
  ASSERT_TRUE(end);
  EXPECT_EQ(gst_event_get_seqnum(end.get()), seek);
}

TEST(Segments, EachNewOneIsSentOnce) {
  StereoHarness harness("max-disparity=64");
  harness.caps(raw_caps("GRAY8", kNumberedWidth, kNumberedHeight));
  int segments = 0;
  count_segments(harness, &segments);
  GstSegment segment = time_segment();
  for (int i = 0; i < 3; ++i) {
    segment.start = segment.base = segment.time = static_cast<GstClockTime>(i) * GST_SECOND;
    harness.segment(segment);
    for (const Side side : {Side::kLeft, Side::kRight}) {
      harness.push(side, numbered_frame(side, i, segment.start));
    }
    EXPECT_TRUE(harness.pull());
    EXPECT_EQ(segments, i + 1) << "each segment is another one";
  }
}

TEST(Segments, AFrameOfANewOneIsNotInTheGapOfTheOldOne) {
  StereoHarness harness("max-disparity=64");
  harness.caps(raw_caps("GRAY8", kNumberedWidth, kNumberedHeight));
  const auto push_pair = [&](int number, GstClockTime time) {
    for (const Side side : {Side::kLeft, Side::kRight}) {
      harness.push(side, numbered_frame(side, number, time));
    }
  };
  push_pair(0, 0);
  EXPECT_TRUE(harness.pull());
  harness.event(Side::kRight, gst_event_new_gap(kFrame, GST_SECOND));
  harness.push(Side::kLeft, numbered_frame(Side::kLeft, 1, kFrame));
  EXPECT_TRUE(harness.wait_for_stats(1, 1, 0));
  GstSegment segment = time_segment();
  segment.base = 2 * GST_SECOND;
  harness.segment(segment);
  push_pair(2, 0);
  const BufferPointer map = harness.pull();
  ASSERT_TRUE(map);
  EXPECT_EQ(frame_difference(map.get()), 0);
}

TEST(EndOfStream, OfOneSideWhileTheOtherOneIsSilentEndsTheOutput) {
  const std::string caps = raw_caps("GRAY8", kNumberedWidth, kNumberedHeight);
  for (const char* side : {"left", "right"}) {
    Pipeline pipeline(
        "mtstereo name=m ! fakesink name=out appsrc name=left format=time caps=" + caps +
        " ! m.sink_left appsrc name=right format=time caps=" + caps + " ! m.sink_right");
    pipeline.set_state(GST_STATE_PLAYING);
    gst_app_src_end_of_stream(GST_APP_SRC(pipeline.named(side)));
    EXPECT_EQ(pipeline.wait_for_end(10), "") << side;
    // Once more after a stop.
    pipeline.set_state(GST_STATE_READY);
    pipeline.set_state(GST_STATE_PLAYING);
    gst_app_src_end_of_stream(GST_APP_SRC(pipeline.named(side)));
    EXPECT_EQ(pipeline.wait_for_end(10), "") << side;
    GstPad* const sink = gst_element_get_static_pad(pipeline.named("out"), "sink");
    EXPECT_TRUE(EventPointer(gst_pad_get_sticky_event(sink, GST_EVENT_STREAM_START, 0))) << side;
    gst_object_unref(sink);
  }
}

}  // namespace
}  // namespace mtstereo::test::gap_test
