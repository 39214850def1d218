// SPDX-License-Identifier: LGPL-2.1-or-later
// Events, flows and latency of mtsplit.
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "cameras/splitter.hpp"

namespace mtstereo::test::mtsplit_streams_test {
namespace {

TEST(MtSplitStreams, EachViewIsAStreamOfItsOwn) {
  Splitter splitter;
  splitter.input().caps(raw_caps("GRAY8", 64, 48));
  std::set<std::string> names;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    GstPad* pad = splitter.side(side)->sinkpad;
    const EventPointer start(gst_pad_get_sticky_event(pad, GST_EVENT_STREAM_START, 0));
    ASSERT_TRUE(start);
    const gchar* name = nullptr;
    gst_event_parse_stream_start(start.get(), &name);
    names.insert(name);
    EXPECT_TRUE(EventPointer(gst_pad_get_sticky_event(pad, GST_EVENT_SEGMENT, 0)));
  }
  EXPECT_EQ(names.size(), 2u);
}

int count_events(GstHarness* harness, GstEventType type) {
  int count = 0;
  while (EventPointer event{gst_harness_try_pull_event(harness)}) {
    if (GST_EVENT_TYPE(event.get()) == type) ++count;
  }
  return count;
}

TEST(MtSplitStreams, BothViewsEndAndFlush) {
  Splitter splitter;
  splitter.input().caps(raw_caps("GRAY8", 64, 48));
  GstHarness* input = splitter.side(Side::kLeft);
  EXPECT_TRUE(gst_harness_push_event(input, gst_event_new_eos()));
  for (const Side side : {Side::kLeft, Side::kRight}) {
    EXPECT_EQ(count_events(splitter.side(side), GST_EVENT_EOS), 1);
  }
  EXPECT_TRUE(gst_harness_push_event(input, gst_event_new_flush_start()));
  EXPECT_TRUE(gst_harness_push_event(input, gst_event_new_flush_stop(TRUE)));
  for (const Side side : {Side::kLeft, Side::kRight}) {
    EXPECT_EQ(count_events(splitter.side(side), GST_EVENT_FLUSH_STOP), 1);
  }
  GstSegment segment;
  gst_segment_init(&segment, GST_FORMAT_TIME);
  EXPECT_TRUE(gst_harness_push_event(input, gst_event_new_segment(&segment)));
  const GrayImage image = noise_pair(64, 48, 0, 5).left;
  EXPECT_EQ(splitter.input().push(frame_buffer(image, 0, kFrame)), GST_FLOW_OK);
}

TEST(MtSplitStreams, SeekOfBothViewsArrivesOnce) {
  Splitter splitter;
  splitter.input().caps(raw_caps("GRAY8", 64, 48));
  while (EventPointer event{gst_harness_try_pull_upstream_event(splitter.side(Side::kLeft))}) {
  }
  const EventPointer seek(gst_event_new_seek(1, GST_FORMAT_TIME, GST_SEEK_FLAG_FLUSH,
                                             GST_SEEK_TYPE_SET, 0, GST_SEEK_TYPE_NONE, 0));
  for (const Side side : {Side::kLeft, Side::kRight}) {
    EXPECT_TRUE(gst_harness_push_upstream_event(splitter.side(side), gst_event_ref(seek.get())));
  }
  int seeks = 0;
  while (EventPointer event{gst_harness_try_pull_upstream_event(splitter.side(Side::kLeft))}) {
    if (GST_EVENT_TYPE(event.get()) == GST_EVENT_SEEK) ++seeks;
  }
  EXPECT_EQ(seeks, 1);
}

TEST(MtSplitStreams, FlowsOfBothPadsAreCombined) {
  const GrayImage image = noise_pair(64, 48, 0, 5).left;
  // The right pad is not linked: the left view continues.
  CameraHarness single("mtsplit", "", "left");
  gst_harness_add_propose_allocation_meta(single.harness(), GST_VIDEO_META_API_TYPE, nullptr);
  single.caps(raw_caps("GRAY8", 64, 48));
  EXPECT_TRUE(single.pass(frame_buffer(image, 0, kFrame)));

  Splitter splitter;
  splitter.input().caps(raw_caps("GRAY8", 64, 48));
  GstPad* left = splitter.side(Side::kLeft)->sinkpad;
  GstPad* right = splitter.side(Side::kRight)->sinkpad;
  const auto end = +[](GstPad*, GstObject*, GstBuffer* buffer) {
    gst_buffer_unref(buffer);
    return GST_FLOW_EOS;
  };
  gst_pad_set_chain_function(left, end);
  EXPECT_EQ(splitter.input().push(frame_buffer(image, 0, kFrame)), GST_FLOW_OK);
  EXPECT_TRUE(splitter.pull(Side::kRight));
  gst_pad_set_chain_function(right, end);
  EXPECT_EQ(splitter.input().push(frame_buffer(image, kFrame, kFrame)), GST_FLOW_EOS);
}

/// The warning of an mtsplit about caps with these fields; "" if there is none.
std::string warning_of(const std::string& properties, const std::string& fields) {
  g_type_ensure(GST_TYPE_VIDEO_MULTIVIEW_FLAGSET);  // for the caps
  Splitter splitter(properties);
  splitter.input().caps(raw_caps("GRAY8", 64, 48) + fields);
  EXPECT_TRUE(splitter.caps(Side::kLeft)) << fields;
  return splitter.input().report(GST_MESSAGE_WARNING);
}

constexpr const char* kRightFirst =
    ", multiview-mode=(string)top-bottom, "
    "multiview-flags=(GstVideoMultiviewFlagsSet)1:ffffffff:/right-view-first";

TEST(MtSplitStreams, WarnOfLayoutsThatTheyContradict) {
  EXPECT_NE(warning_of("", ",multiview-mode=(string)top-bottom").find("set layout=top-bottom"),
            std::string::npos);
  EXPECT_NE(warning_of("layout=top-bottom", ",multiview-mode=(string)side-by-side")
                .find("set layout=side-by-side"),
            std::string::npos);
  EXPECT_NE(warning_of("", ",multiview-mode=(string)row-interleaved").find("row-interleaved, but"),
            std::string::npos);
  EXPECT_NE(warning_of("layout=top-bottom", kRightFirst).find("set swap=true"), std::string::npos);
}

TEST(MtSplitStreams, WithTheLayoutThatTheyStateCauseNoWarning) {
  EXPECT_EQ(warning_of("", ""), "");
  EXPECT_EQ(warning_of("", ",multiview-mode=(string)mono"), "");
  EXPECT_EQ(warning_of("", ",multiview-mode=(string)side-by-side"), "");
  EXPECT_EQ(warning_of("layout=top-bottom swap=true", kRightFirst), "");
}

TEST(MtSplitStreams, LatencyIsThatOfUpstream) {
  Splitter splitter;
  splitter.input().caps(raw_caps("GRAY8", 64, 48));
  gst_harness_set_upstream_latency(splitter.side(Side::kLeft), 40 * GST_MSECOND);
  EXPECT_EQ(gst_harness_query_latency(splitter.side(Side::kLeft)), 40 * GST_MSECOND);
}

}  // namespace
}  // namespace mtstereo::test::mtsplit_streams_test
