// SPDX-License-Identifier: LGPL-2.1-or-later
// Complete pipelines: determinism, seeking, restarts, several pipelines at once.
#include "support/pipeline.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "support/stereo_harness.hpp"

namespace mtstereo::test::pipeline_test {
namespace {

std::vector<Sample> play(const std::string& launch) {
  Pipeline pipeline(launch);
  EXPECT_EQ(pipeline.run(), "") << launch;
  return pipeline.samples();
}

void expect_same(const std::vector<Sample>& expected, const std::vector<Sample>& actual,
                 const std::string& where) {
  ASSERT_EQ(expected.size(), actual.size()) << where;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(expected[i].pts, actual[i].pts) << where << " frame " << i;
    EXPECT_TRUE(expected[i].bytes == actual[i].bytes) << where << " frame " << i;
  }
}

// Feature: own threads, with the same result for any number
// Feature: files: complete and reproducible
TEST(Pipelines, AreDeterministicForAnyNumberOfThreads) {
  const auto expected = play(noise_launch(20, "max-disparity=16 threads=1"));
  EXPECT_EQ(expected.size(), 20u);
  for (const char* threads : {"1", "2", "4"}) {
    expect_same(expected,
                play(noise_launch(20, std::string("max-disparity=16 threads=") + threads)),
                std::string(threads) + " threads");
  }
}

TEST(Pipelines, CanBeRestartedAfterNull) {
  Pipeline pipeline(noise_launch(10, "max-disparity=16"));
  ASSERT_EQ(pipeline.run(), "");
  const auto first = pipeline.samples();
  ASSERT_EQ(first.size(), 10u);
  for (int i = 0; i < 2; ++i) {
    pipeline.set_state(GST_STATE_NULL);
    ASSERT_EQ(pipeline.run(), "");
    expect_same(first, pipeline.samples(), "run " + std::to_string(i + 2));
    EXPECT_EQ(stats_of(pipeline.named("m")).pairs, 10u) << "the statistics must restart at zero";
  }
}

TEST(Pipelines, WarnOfEachRunWithoutAPair) {
  Pipeline pipeline(noise_launch(10, "max-disparity=16"));
  int warnings = 0;
  GstBus* bus = gst_element_get_bus(pipeline.element());
  gst_bus_enable_sync_message_emission(bus);
  const auto count = +[](GstBus*, GstMessage*, int* warnings) { ++*warnings; };
  g_signal_connect(bus, "sync-message::warning", G_CALLBACK(count), &warnings);
  gst_object_unref(bus);
  ASSERT_EQ(pipeline.run(), "");
  EXPECT_EQ(warnings, 0);
  gst_child_proxy_set(GST_CHILD_PROXY(pipeline.named("m")), "sink_right::offset",
                      gint64{5} * GST_SECOND, nullptr);
  for (int run = 1; run <= 2; ++run) {
    pipeline.set_state(GST_STATE_NULL);
    ASSERT_EQ(pipeline.run(), "");
    EXPECT_EQ(warnings, run);
  }
}

// Feature: several elements in one process
TEST(Pipelines, DoNotAffectEachOtherInOneProcess) {
  const std::string one = noise_launch(15, "max-disparity=16 mode=sparse threads=2", 3);
  const std::string two = noise_launch(15, "max-disparity=32 mode=semi-dense gray-levels=12", 7);
  const auto one_alone = play(one);
  const auto two_alone = play(two);
  Pipeline first(one);
  Pipeline second(two);
  first.set_state(GST_STATE_PLAYING);
  second.set_state(GST_STATE_PLAYING);
  EXPECT_EQ(first.wait_for_end(), "");
  EXPECT_EQ(second.wait_for_end(), "");
  expect_same(one_alone, first.samples(), "first");
  expect_same(two_alone, second.samples(), "second");
}

// Feature: seeks
TEST(Pipelines, SupportRepeatedFlushingSeeks) {
  Pipeline pipeline(noise_launch(-1, "max-disparity=16"));
  pipeline.set_state(GST_STATE_PAUSED);
  ASSERT_TRUE(pipeline.wait_until_settled());
  for (const GstClockTime to : {2u, 0u, 3u, 1u, 2u, 0u, 1u, 3u}) {
    ASSERT_TRUE(pipeline.seek(
        to * GST_SECOND, static_cast<GstSeekFlags>(GST_SEEK_FLAG_FLUSH | GST_SEEK_FLAG_ACCURATE)));
    ASSERT_TRUE(pipeline.wait_until_settled()) << "to " << to;
    GstSample* preroll = nullptr;
    g_signal_emit_by_name(pipeline.named("out"), "try-pull-preroll", GST_SECOND * 10, &preroll);
    ASSERT_NE(preroll, nullptr) << "to " << to;
    EXPECT_EQ(GST_BUFFER_PTS(gst_sample_get_buffer(preroll)), to * GST_SECOND);
    gst_sample_unref(preroll);
  }
}

/// The duration of two streams with these numbers of frames, -1: without an end [frames of 1/30 s].
/// -1: unknown.
gint64 duration_of(int left, int right) {
  const auto source = [](int frames, const char* pad) {
    return " videotestsrc num-buffers=" + std::to_string(frames) +
           " ! video/x-raw,format=GRAY8,width=64,height=48,framerate=30/1 ! m." + pad;
  };
  Pipeline pipeline("mtstereo name=m max-disparity=16 ! appsink name=out" +
                    source(left, "sink_left") + source(right, "sink_right"));
  pipeline.set_state(GST_STATE_PAUSED);
  EXPECT_TRUE(pipeline.wait_until_settled());
  gint64 duration = 0;
  if (!gst_element_query_duration(pipeline.named("m"), GST_FORMAT_TIME, &duration)) return -1;
  if (duration < 0) return -1;
  return duration * 30 / static_cast<gint64>(GST_SECOND);
}

// Feature: seeks
TEST(Pipelines, HaveTheDurationOfTheShorterStream) {
  EXPECT_EQ(duration_of(60, 60), 60);
  EXPECT_EQ(duration_of(60, 30), 30);
  EXPECT_EQ(duration_of(30, 60), 30);
}

TEST(Pipelines, HaveTheDurationThatIsKnown) {
  EXPECT_EQ(duration_of(30, -1), 30);
  EXPECT_EQ(duration_of(-1, 30), 30);
  EXPECT_EQ(duration_of(-1, -1), -1);
}

/// Makes the next frame of sink_right too short for its caps.
GstPadProbeReturn shorten(GstPad*, GstPadProbeInfo* info, gpointer) {
  GstBuffer* buffer = gst_buffer_make_writable(GST_PAD_PROBE_INFO_BUFFER(info));
  gst_buffer_set_size(buffer, 10);
  GST_PAD_PROBE_INFO_DATA(info) = buffer;
  return GST_PAD_PROBE_REMOVE;
}

TEST(Pipelines, PlayAgainByAFlushingSeekAfterAnError) {
  Pipeline pipeline(noise_launch(-1, "max-disparity=16"));
  pipeline.set_state(GST_STATE_PLAYING);
  ASSERT_TRUE(pipeline.wait_until_settled());
  GstPad* pad = gst_element_get_static_pad(pipeline.named("m"), "sink_right");
  gst_pad_add_probe(pad, GST_PAD_PROBE_TYPE_BUFFER, shorten, nullptr, nullptr);
  gst_object_unref(pad);
  ASSERT_NE(pipeline.wait_for_end().find("sink_right"), std::string::npos);
  // The elements upstream post errors too.
  while (pipeline.wait_for_end(0.2).find("timeout") == std::string::npos) continue;
  pipeline.samples();
  ASSERT_TRUE(gst_element_seek(pipeline.element(), 1, GST_FORMAT_TIME, GST_SEEK_FLAG_FLUSH,
                               GST_SEEK_TYPE_SET, 0, GST_SEEK_TYPE_SET, GST_SECOND / 2));
  pipeline.set_state(GST_STATE_PLAYING);
  EXPECT_EQ(pipeline.wait_for_end(10), "");
  EXPECT_EQ(pipeline.samples().size(), 15u);
}

TEST(Pipelines, AnswerSeekingDurationAndPositionQueries) {
  Pipeline pipeline(noise_launch(90, "max-disparity=16"));
  pipeline.set_state(GST_STATE_PAUSED);
  ASSERT_TRUE(pipeline.wait_until_settled());
  GstPad* pad = gst_element_get_static_pad(pipeline.named("m"), "src");
  GstQuery* query = gst_query_new_seeking(GST_FORMAT_TIME);
  ASSERT_TRUE(gst_pad_query(pad, query));
  gboolean seekable = FALSE;
  gst_query_parse_seeking(query, nullptr, &seekable, nullptr, nullptr);
  EXPECT_TRUE(seekable);
  gst_query_unref(query);
  gint64 duration = 0;
  EXPECT_TRUE(gst_pad_query_duration(pad, GST_FORMAT_TIME, &duration));
  EXPECT_NEAR(static_cast<double>(duration), 3.0 * GST_SECOND, 1e6);
  gint64 position = -1;
  EXPECT_TRUE(gst_pad_query_position(pad, GST_FORMAT_TIME, &position));
  EXPECT_GE(position, 0);
  EXPECT_LT(position, static_cast<gint64>(GST_SECOND));
  gst_object_unref(pad);
}

TEST(Pipelines, AreSeekableOnlyIfBothSourcesAre) {
  Pipeline pipeline(
      "videotestsrc ! video/x-raw,width=64,height=48 ! mtstereo name=m max-disparity=16 ! "
      "fakesink appsrc name=a format=time caps=video/x-raw,format=GRAY8,width=64,height=48 ! "
      "m.sink_right");
  pipeline.set_state(GST_STATE_PAUSED);
  GstPad* pad = gst_element_get_static_pad(pipeline.named("m"), "src");
  GstQuery* query = gst_query_new_seeking(GST_FORMAT_TIME);
  ASSERT_TRUE(gst_pad_query(pad, query));
  gboolean seekable = TRUE;
  gst_query_parse_seeking(query, nullptr, &seekable, nullptr, nullptr);
  EXPECT_FALSE(seekable);
  gst_query_unref(query);
  gst_object_unref(pad);
}

TEST(Pipelines, PlayLiveSources) {
  Pipeline pipeline(
      "mtstereo name=m max-disparity=16 ! appsink name=out wait-on-eos=false "
      "videotestsrc is-live=true num-buffers=15 ! video/x-raw,width=64,height=48 ! m.sink_left "
      "videotestsrc is-live=true num-buffers=15 ! video/x-raw,width=64,height=48 ! m.sink_right");
  ASSERT_EQ(pipeline.run(), "");
  const Stats stats = stats_of(pipeline.named("m"));
  // On a busy machine some frames may miss their partners.
  EXPECT_GE(stats.pairs, 5u);
  EXPECT_EQ(pipeline.samples().size(), stats.pairs);
}

// Feature: errors as messages with a remedy, no output on stdout
TEST(Pipelines, PostTheErrorOfTheElementFirst) {
  Pipeline pipeline(
      "mtstereo name=m max-disparity=16 ! fakesink "
      "videotestsrc ! video/x-raw,width=64,height=48 ! m.sink_left "
      "videotestsrc ! video/x-raw,width=32,height=48 ! m.sink_right");
  const std::string error = pipeline.run();
  EXPECT_EQ(error.rfind("m: ", 0), 0u) << error;
  EXPECT_NE(error.find("left 64x48, right 32x48"), std::string::npos) << error;
}

TEST(Pipelines, ReportInterlacedVideo) {
  Pipeline pipeline(
      "mtstereo name=m max-disparity=16 ! fakesink "
      "videotestsrc ! video/x-raw,width=64,height=48,framerate=30/1 ! interlace ! m.sink_left "
      "videotestsrc ! video/x-raw,width=64,height=48 ! m.sink_right");
  const std::string error = pipeline.run();
  EXPECT_EQ(error.rfind("m: ", 0), 0u) << error;
  EXPECT_NE(error.find("deinterlace"), std::string::npos) << error;
}

// Feature: interlaced video is rejected with a remedy
TEST(Pipelines, AcceptDeinterlacedVideo) {
  Pipeline pipeline(
      "mtstereo name=m max-disparity=16 ! appsink name=out wait-on-eos=false sync=false "
      "videotestsrc num-buffers=10 ! video/x-raw,width=64,height=48,framerate=30/1 ! tee name=t "
      "t. ! queue ! interlace ! deinterlace ! m.sink_left "
      "t. ! queue ! interlace ! deinterlace ! m.sink_right");
  EXPECT_EQ(pipeline.run(), "");
  EXPECT_FALSE(pipeline.samples().empty());
}

// Feature: a part of the image only
TEST(Pipelines, SupportSideBySideVideoByVideocrop) {
  Pipeline pipeline(
      "videotestsrc num-buffers=5 pattern=ball ! video/x-raw,format=GRAY8,width=256,height=96 ! "
      "tee name=t mtstereo name=m max-disparity=16 ! appsink name=out wait-on-eos=false sync=false "
      "t. ! queue ! videocrop right=128 ! m.sink_left "
      "t. ! queue ! videocrop left=128 ! m.sink_right");
  EXPECT_EQ(pipeline.run(), "");
  EXPECT_EQ(pipeline.samples().size(), 5u);
}

// Feature: idle if nobody consumes
TEST(Pipelines, StopBeforeTheEnd) {
  for (int i = 0; i < 10; ++i) {
    Pipeline pipeline(noise_launch(10000, "max-disparity=16"));
    pipeline.set_state(GST_STATE_PLAYING);
    std::this_thread::sleep_for(std::chrono::milliseconds(7 * i));
  }
}

}  // namespace
}  // namespace mtstereo::test::pipeline_test
