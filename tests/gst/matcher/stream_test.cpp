// SPDX-License-Identifier: LGPL-2.1-or-later
// Events, flags, metas and the end of streams.
#include <gtest/gtest.h>

#include "support/fixtures.hpp"

namespace mtstereo::test::stream_test {
namespace {

constexpr int kWidth = 64;
constexpr int kHeight = 48;

class Stream : public StreamsTest {
 protected:
  Stream() { start(); }
  void flush(Side side, std::uint32_t seqnum) {
    GstEvent* begin = gst_event_new_flush_start();
    gst_event_set_seqnum(begin, seqnum);
    harness->event(side, begin);
  }
  void end_flush(Side side, std::uint32_t seqnum) {
    GstEvent* end = gst_event_new_flush_stop(TRUE);
    gst_event_set_seqnum(end, seqnum);
    harness->event(side, end);
    const GstSegment segment = time_segment();
    harness->event(side, gst_event_new_segment(&segment));
  }
};

// Feature: the end of one stream ends the output
TEST_F(Stream, EndsAfterTheRightStream) {
  harness->push_pair(pair, 0);
  harness->end(Side::kRight);
  left(kFrame);
  EXPECT_TRUE(harness->pull_event(GST_EVENT_EOS));
  EXPECT_TRUE(harness->pull(1)) << "the pair before the end is lost";
  EXPECT_TRUE(harness->wait_for_stats(1, 1, 0));
  EXPECT_EQ(left(2 * kFrame), GST_FLOW_EOS) << "the source of the other stream must stop";
}

// Feature: the end of one stream ends the output
TEST_F(Stream, EndsAfterTheLeftStream) {
  harness->push_pair(pair, 0);
  right(kFrame);
  harness->end(Side::kLeft);
  EXPECT_TRUE(harness->pull_event(GST_EVENT_EOS));
  EXPECT_TRUE(harness->wait_for_stats(1, 0, 1));
  EXPECT_EQ(right(2 * kFrame), GST_FLOW_EOS);
}

// Feature: the end of one stream ends the output
TEST_F(Stream, MatchesTheWaitingPairBeforeItEnds) {
  left(0);
  harness->end(Side::kLeft);
  EXPECT_TRUE(harness->silent());
  right(0);
  EXPECT_TRUE(harness->pull_event(GST_EVENT_EOS));
  EXPECT_TRUE(harness->pull(1));
}

TEST_F(Stream, WarnsOnceIfItEndsWithoutAPair) {
  left(0);
  harness->end(Side::kRight);
  left(kFrame);
  EXPECT_TRUE(harness->pull_event(GST_EVENT_EOS));
  left(2 * kFrame);
  harness->end(Side::kLeft);
  EXPECT_NE(harness->warning().text.find("have ended, and no frame has arrived on sink_right"),
            std::string::npos);
  EXPECT_EQ(harness->warning(0.1).text, "");
}

TEST_F(Stream, WarnsIfItEndsAndNoFramesWereAPair) {
  left(0);
  right(5 * GST_SECOND);
  harness->end(Side::kLeft);
  harness->end(Side::kRight);
  EXPECT_TRUE(harness->pull_event(GST_EVENT_EOS));
  const Report warning = harness->warning();
  EXPECT_NE(warning.text.find("no two of their frames were a pair"), std::string::npos)
      << warning.text;
  EXPECT_NE(warning.text.find("sync-mode=first-pts"), std::string::npos) << warning.text;
}

TEST_F(Stream, DoesNotWarnIfItEndsAfterAPair) {
  ASSERT_TRUE(next());
  left(kFrame);
  harness->end(Side::kRight);
  EXPECT_TRUE(harness->pull_event(GST_EVENT_EOS));
  EXPECT_TRUE(harness->warnings().empty());
}

// Feature: the end of one stream ends the output
TEST_F(Stream, EndsImmediatelyIfTheOtherStreamIsSilent) {
  ASSERT_TRUE(next());
  harness->end(Side::kLeft);
  EXPECT_TRUE(harness->pull_event(GST_EVENT_EOS));
  EXPECT_EQ(harness->further_errors(), 0);
}

TEST_F(Stream, SendsEndOfStreamOnce) {
  ASSERT_TRUE(next());
  harness->end(Side::kLeft);
  harness->end(Side::kRight);
  ASSERT_TRUE(harness->pull_event(GST_EVENT_EOS));
  EXPECT_FALSE(harness->pull_event(GST_EVENT_EOS, 0.2));
}

TEST_F(Stream, SendsTheEndOfASegmentOfTheLeftStreamOnly) {
  ASSERT_TRUE(next());
  harness->event(Side::kRight, gst_event_new_segment_done(GST_FORMAT_TIME, kFrame));
  harness->event(Side::kLeft, gst_event_new_segment_done(GST_FORMAT_TIME, kFrame));
  ASSERT_TRUE(harness->pull_event(GST_EVENT_SEGMENT_DONE));
  EXPECT_FALSE(harness->pull_event(GST_EVENT_SEGMENT_DONE, 0.2));
}

TEST_F(Stream, EndsWithoutFrames) {
  harness->end(Side::kLeft);
  harness->end(Side::kRight);
  EXPECT_TRUE(harness->pull_event(GST_EVENT_EOS));
  EXPECT_EQ(harness->further_errors(), 0);
}

TEST_F(Stream, SendsStreamStartCapsAndSegmentBeforeTheFirstMap) {
  ASSERT_TRUE(next());
  for (const GstEventType type : {GST_EVENT_STREAM_START, GST_EVENT_CAPS, GST_EVENT_SEGMENT}) {
    const EventPointer event(gst_harness_pull_event(harness->output()));
    ASSERT_TRUE(event);
    EXPECT_EQ(GST_EVENT_TYPE(event.get()), type) << GST_EVENT_TYPE_NAME(event.get());
  }
}

// Feature: times and segment of the left stream
TEST_F(Stream, KeepsTheSegmentOfTheLeftStream) {
  GstSegment segment = time_segment();
  segment.start = 3 * GST_SECOND;
  segment.time = 7 * GST_SECOND;
  segment.base = GST_SECOND;
  harness->event(Side::kLeft, gst_event_new_segment(&segment));
  segment.time = 9 * GST_SECOND;
  harness->event(Side::kRight, gst_event_new_segment(&segment));
  harness->push_pair(pair, 3 * GST_SECOND);
  ASSERT_TRUE(harness->pull());
  const EventPointer event = harness->pull_event(GST_EVENT_SEGMENT);
  ASSERT_TRUE(event);
  const GstSegment* out = nullptr;
  gst_event_parse_segment(event.get(), &out);
  EXPECT_EQ(out->start, 3 * GST_SECOND);
  EXPECT_EQ(out->time, 7 * GST_SECOND);
  EXPECT_EQ(out->base, GST_SECOND);
}

TEST_F(Stream, ReportsASegmentInBytes) {
  GstSegment segment;
  gst_segment_init(&segment, GST_FORMAT_BYTES);
  harness->event(Side::kRight, gst_event_new_segment(&segment));
  const Report error = harness->error();
  EXPECT_NE(error.text.find("sink_right"), std::string::npos) << error.text;
  EXPECT_NE(error.text.find("bytes"), std::string::npos) << error.text;
  EXPECT_EQ(harness->further_errors(), 0);
}

// Feature: times and segment of the left stream
// Feature: gaps and flags
TEST_F(Stream, KeepsTimesFlagsAndOffsetsOfTheLeftFrame) {
  GstBuffer* left = frame_buffer(pair.left, 4 * kFrame, kFrame);
  GST_BUFFER_DTS(left) = 3 * kFrame;
  GST_BUFFER_OFFSET(left) = 41;
  GST_BUFFER_OFFSET_END(left) = 42;
  GST_BUFFER_FLAG_SET(left, GST_BUFFER_FLAG_DISCONT);
  GstBuffer* right = frame_buffer(pair.right, 4 * kFrame + 1, kFrame / 2);
  GST_BUFFER_FLAG_SET(right, GST_BUFFER_FLAG_MARKER);
  GST_BUFFER_FLAG_SET(right, GST_BUFFER_FLAG_CORRUPTED);
  harness->push(Side::kLeft, left);
  harness->push(Side::kRight, right);
  const BufferPointer map = harness->pull();
  ASSERT_TRUE(map);
  EXPECT_EQ(GST_BUFFER_PTS(map.get()), 4 * kFrame);
  EXPECT_EQ(GST_BUFFER_DTS(map.get()), GST_CLOCK_TIME_NONE);
  EXPECT_EQ(GST_BUFFER_DURATION(map.get()), kFrame);
  EXPECT_EQ(GST_BUFFER_OFFSET(map.get()), 41u);
  EXPECT_EQ(GST_BUFFER_OFFSET_END(map.get()), 42u);
  EXPECT_TRUE(GST_BUFFER_FLAG_IS_SET(map.get(), GST_BUFFER_FLAG_DISCONT));
  EXPECT_FALSE(GST_BUFFER_FLAG_IS_SET(map.get(), GST_BUFFER_FLAG_MARKER));
  EXPECT_TRUE(GST_BUFFER_FLAG_IS_SET(map.get(), GST_BUFFER_FLAG_CORRUPTED))
      << "a map of a corrupted right frame is corrupted";
  harness->push_pair(pair, 5 * kFrame);
  const BufferPointer next = harness->pull();
  ASSERT_TRUE(next);
  EXPECT_FALSE(GST_BUFFER_FLAG_IS_SET(next.get(), GST_BUFFER_FLAG_DISCONT));
  EXPECT_FALSE(GST_BUFFER_FLAG_IS_SET(next.get(), GST_BUFFER_FLAG_CORRUPTED));
}

TEST_F(Stream, WarnsOnceOfEachSideThatADecoderMarksAsDamaged) {
  for (GstClockTime i = 0; i < 4; ++i) {
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const bool damaged = i >= (side == Side::kLeft ? 2U : 1U);
      GstBuffer* frame =
          frame_buffer(side == Side::kLeft ? pair.left : pair.right, i * kFrame, kFrame);
      if (damaged) GST_BUFFER_FLAG_SET(frame, GST_BUFFER_FLAG_CORRUPTED);
      harness->push(side, frame);
    }
    ASSERT_TRUE(harness->pull());
  }
  const std::vector<Report> warnings = harness->warnings();
  ASSERT_EQ(warnings.size(), 2U);
  EXPECT_NE(warnings[0].text.find("a frame of sink_right as damaged"), std::string::npos);
  EXPECT_NE(warnings[1].text.find("a frame of sink_left as damaged"), std::string::npos);
  EXPECT_NE(warnings[1].text.find("discard-corrupted-frames=true"), std::string::npos);
}

// Feature: metas of the left frame are kept, and own metas can be read without headers
TEST_F(Stream, CopiesTheMetasOfTheLeftFrameExceptItsLayout) {
  const CapsPointer reference(gst_caps_from_string("timestamp/x-ntp"));
  GstBuffer* left = frame_buffer(pair.left, 0, kFrame, {.padding = 16});
  gst_buffer_add_reference_timestamp_meta(left, reference.get(), 77, GST_CLOCK_TIME_NONE);
  GstBuffer* right = frame_buffer(pair.right, 0, kFrame);
  gst_buffer_add_reference_timestamp_meta(right, reference.get(), 88, GST_CLOCK_TIME_NONE);
  harness->push(Side::kLeft, left);
  harness->push(Side::kRight, right);
  const BufferPointer map = harness->pull();
  ASSERT_TRUE(map);
  const auto* meta = gst_buffer_get_reference_timestamp_meta(map.get(), reference.get());
  ASSERT_NE(meta, nullptr);
  EXPECT_EQ(meta->timestamp, 77u);
  EXPECT_EQ(gst_buffer_get_n_meta(map.get(), GST_REFERENCE_TIMESTAMP_META_API_TYPE), 1u);
  const GstVideoMeta* video = gst_buffer_get_video_meta(map.get());
  EXPECT_TRUE(video == nullptr || video->format == GST_VIDEO_FORMAT_GRAY16_LE);
}

// Feature: gaps and flags
TEST_F(Stream, ForwardsAGapOfTheLeftStream) {
  ASSERT_TRUE(next());
  harness->event(Side::kLeft, gst_event_new_gap(kFrame, 2 * kFrame));
  right(kFrame);
  const EventPointer gap = harness->pull_event(GST_EVENT_GAP);
  ASSERT_TRUE(gap);
  GstClockTime time = 0;
  GstClockTime duration = 0;
  gst_event_parse_gap(gap.get(), &time, &duration);
  EXPECT_EQ(time, kFrame);
  EXPECT_EQ(duration, 2 * kFrame);
  left(3 * kFrame);
  right(3 * kFrame);
  expect_map_at(3 * kFrame);
  EXPECT_TRUE(harness->wait_for_stats(2, 0, 1));
}

// Feature: times and segment of the left stream
TEST_F(Stream, SendsTheSegmentBeforeAFirstGap) {
  harness->event(Side::kLeft, gst_event_new_gap(0, kFrame));
  right(0);
  EXPECT_TRUE(harness->pull_event(GST_EVENT_SEGMENT));
  EXPECT_TRUE(harness->pull_event(GST_EVENT_GAP)) << "the gap was sent before the segment";
}

// Feature: times and segment of the left stream
TEST_F(Stream, SendsTheSegmentBeforeAGapAfterAFlush) {
  ASSERT_TRUE(next());
  for (const Side side : {Side::kLeft, Side::kRight}) flush(side, 7);
  for (const Side side : {Side::kLeft, Side::kRight}) end_flush(side, 7);
  ASSERT_TRUE(harness->pull_event(GST_EVENT_FLUSH_STOP));
  harness->event(Side::kLeft, gst_event_new_gap(0, kFrame));
  right(0);
  EXPECT_TRUE(harness->pull_event(GST_EVENT_SEGMENT));
  EXPECT_TRUE(harness->pull_event(GST_EVENT_GAP)) << "the gap was sent before the segment";
}

TEST(StreamStart, IgnoresAGapBeforeTheSegment) {
  const Pair pair = noise_pair(kWidth, kHeight, 5, 2);
  StereoHarness harness;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    harness.event(side, gst_event_new_gap(0, kFrame));
  }
  harness.caps(raw_caps("GRAY8", kWidth, kHeight));
  harness.push_pair(pair, 0);
  EXPECT_TRUE(harness.pull());
}

// Feature: gaps and flags
TEST_F(Stream, DropsLeftFramesInAGapOfTheRightStream) {
  ASSERT_TRUE(next());
  harness->event(Side::kRight, gst_event_new_gap(kFrame, kFrame));
  left(kFrame);
  right(2 * kFrame);
  left(2 * kFrame);
  expect_map_at(2 * kFrame);
  EXPECT_TRUE(harness->wait_for_stats(2, 1, 0));
}

TEST_F(Stream, AFlushDiscardsWaitingFrames) {
  ASSERT_TRUE(next());
  left(kFrame);
  for (const Side side : {Side::kLeft, Side::kRight}) flush(side, 7);
  for (const Side side : {Side::kLeft, Side::kRight}) end_flush(side, 7);
  EXPECT_TRUE(harness->pull_event(GST_EVENT_FLUSH_STOP));
  harness->push_pair(pair, 0);
  expect_map_at(0u);
  EXPECT_TRUE(harness->wait_for_stats(2, 0, 0));
}

TEST_F(Stream, AFlushAfterTheEndRestartsTheStream) {
  harness->push_pair(pair, 0);
  harness->end(Side::kLeft);
  harness->end(Side::kRight);
  ASSERT_TRUE(harness->pull_event(GST_EVENT_EOS));
  ASSERT_TRUE(harness->pull());
  for (const Side side : {Side::kLeft, Side::kRight}) flush(side, 9);
  for (const Side side : {Side::kLeft, Side::kRight}) end_flush(side, 9);
  harness->push_pair(pair, 0);
  EXPECT_TRUE(harness->pull());
}

TEST_F(Stream, WithManyWrongTimeStampsIsReportedWithTheRemedy) {
  std::vector<GstClockTime> lefts, rights;
  for (GstClockTime i = 0; i < 80; ++i) {
    lefts.push_back(i / 2 * kFrame);  // each one twice
    rights.push_back(i * kFrame);
  }
  const Feeder left(*harness, Side::kLeft, pair, lefts);
  const Feeder right(*harness, Side::kRight, pair, rights);
  const Report warning = harness->warning();
  EXPECT_NE(warning.text.find("30 frames of sink_left"), std::string::npos) << warning.text;
  EXPECT_NE(warning.text.find("jump or repeat"), std::string::npos) << warning.text;
  EXPECT_NE(warning.text.find("do-timestamp=true"), std::string::npos) << warning.text;
}

TEST_F(Stream, OfDarkViewsIsReportedOnce) {
  for (GrayImage* image : {&pair.left, &pair.right}) {
    for (std::uint8_t& pixel : image->pixels) pixel /= 240;  // as behind a lens cap
  }
  for (int i = 0; i < 60; ++i) ASSERT_TRUE(next()) << i;
  const Report warning = harness->warning();
  EXPECT_NE(warning.text.find("disparities in 0.0 %"), std::string::npos) << warning.text;
  for (int i = 0; i < 60; ++i) ASSERT_TRUE(next()) << i;
  EXPECT_TRUE(harness->warnings().empty());
}

TEST_F(Stream, ReleasesInputFrames) {
  GstBuffer* left = frame_buffer(pair.left, 0, kFrame);
  GstBuffer* right = frame_buffer(pair.right, 0, kFrame);
  const BufferPointer left_keeper(gst_buffer_ref(left));
  const BufferPointer right_keeper(gst_buffer_ref(right));
  harness->push(Side::kLeft, left);
  harness->push(Side::kRight, right);
  ASSERT_TRUE(harness->pull());
  harness->push_pair(pair, kFrame);  // when its map is there, the previous step is complete
  ASSERT_TRUE(harness->pull());
  EXPECT_EQ(GST_MINI_OBJECT_REFCOUNT_VALUE(left_keeper.get()), 1);
  EXPECT_EQ(GST_MINI_OBJECT_REFCOUNT_VALUE(right_keeper.get()), 1);
}

}  // namespace
}  // namespace mtstereo::test::stream_test
