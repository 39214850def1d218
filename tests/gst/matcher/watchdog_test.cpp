// SPDX-License-Identifier: LGPL-2.1-or-later
// A pad that is not linked, or on which no frames arrive, is reported.
#include <gst/app/gstappsrc.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <future>

#include "support/fixtures.hpp"
#include "support/pipeline.hpp"

namespace mtstereo::test::watchdog_test {
namespace {

constexpr int kWidth = 64;
constexpr int kHeight = 48;
constexpr const char* kShort = "max-disparity=16 timeout=100000000";

/// The text of the next warning of a pipeline; "" if none comes.
std::string warning_of(const Pipeline& pipeline, double seconds) {
  GstBus* bus = gst_element_get_bus(pipeline.element());
  const MessagePointer message(gst_bus_timed_pop_filtered(
      bus, static_cast<GstClockTime>(seconds * GST_SECOND), GST_MESSAGE_WARNING));
  gst_object_unref(bus);
  return message ? report_of(message.get()).text : "";
}

class SilentPad : public StreamsTest {
 protected:
  void start(const std::string& properties = kShort, bool live = false) {
    StreamsTest::start(properties, live);
  }
};

// Feature: a pad that is not linked or silent is reported
TEST_F(SilentPad, IsNamedInAWarning) {
  for (const Side waiting : {Side::kLeft, Side::kRight}) {
    start();
    push(waiting, 0);
    const Report warning = harness->warning();
    const std::string name = waiting == Side::kLeft ? "sink_right" : "sink_left";
    EXPECT_NE(warning.text.find("arrived on " + name + " for 0.1 s"), std::string::npos)
        << warning.text;
    EXPECT_NE(warning.details.find("timeout"), std::string::npos) << warning.details;
  }
}

TEST_F(SilentPad, IsReportedOnceAndThePipelineGoesOn) {
  start();
  push(Side::kLeft, 0);
  EXPECT_NE(harness->warning().text, "");
  EXPECT_TRUE(harness->warnings(0.4).empty());
  push(Side::kRight, 0);
  EXPECT_TRUE(harness->pull());
}

TEST_F(SilentPad, IsReportedAgainAfterFramesHaveArrived) {
  start();
  push(Side::kLeft, 0);
  EXPECT_NE(harness->warning().text, "");
  push(Side::kRight, 0);
  ASSERT_TRUE(harness->pull());
  push(Side::kLeft, kFrame);
  EXPECT_NE(harness->warning().text, "");
}

TEST_F(SilentPad, IsReportedAfterAFlush) {
  start();
  push(Side::kLeft, 0);
  EXPECT_NE(harness->warning().text, "");
  harness->flush(7);
  EXPECT_TRUE(harness->warnings(0.3).empty()) << "no frame waits";
  push(Side::kLeft, 0);
  EXPECT_NE(harness->warning().text, "");
}

TEST_F(SilentPad, IsNotReportedWhileNoFrameWaits) {
  start();
  EXPECT_TRUE(harness->warnings(0.3).empty());
  ASSERT_TRUE(next());
  EXPECT_TRUE(harness->warnings(0.3).empty());
}

TEST_F(SilentPad, IsNotReportedWithoutATimeout) {
  start("max-disparity=16 timeout=0");
  push(Side::kLeft, 0);
  EXPECT_TRUE(harness->warnings(0.3).empty());
}

TEST_F(SilentPad, TheTimeoutMayChangeWhilePlaying) {
  start("max-disparity=16 timeout=0");
  push(Side::kLeft, 0);
  g_object_set(harness->element(), "timeout", static_cast<guint64>(50 * GST_MSECOND), nullptr);
  EXPECT_NE(harness->warning().text, "");
  guint64 timeout = 0;
  g_object_get(harness->element(), "timeout", &timeout, nullptr);
  EXPECT_EQ(timeout, 50 * GST_MSECOND);
}

TEST_F(SilentPad, OfALiveStreamHasADeadlineInstead) {
  start(kShort, true);
  push(Side::kLeft, 0);
  EXPECT_TRUE(harness->warnings(0.4).empty());
}

TEST_F(SilentPad, IsNotReportedAfterTheElementWasStopped) {
  start();
  push(Side::kLeft, 0);
  EXPECT_NE(harness->warning().text, "");
  gst_element_set_state(harness->element(), GST_STATE_READY);
  EXPECT_TRUE(harness->warnings(0.3).empty());
}

class SilentStreams : public SilentPad {};

// Feature: a pad that is not linked or silent is reported
TEST_F(SilentStreams, OfLiveSourcesAreReportedOnce) {
  start(kShort, true);
  const Report warning = harness->warning();
  EXPECT_NE(warning.text.find("sink_left and sink_right for 0.2 s"), std::string::npos)
      << warning.text;
  EXPECT_NE(warning.text.find("sender"), std::string::npos) << warning.text;
  EXPECT_NE(warning.details.find("sink_right has a format"), std::string::npos) << warning.details;
  EXPECT_TRUE(harness->warnings(0.5).empty());
  EXPECT_TRUE(next());
}

TEST_F(SilentStreams, AreNotReportedAfterTheFirstFrame) {
  start(kShort, true);
  ASSERT_TRUE(next());
  EXPECT_TRUE(harness->warnings(0.5).empty());
}

TEST_F(SilentStreams, AreNotReportedAfterAFlush) {
  start(kShort, true);
  ASSERT_TRUE(next());
  harness->flush(7);
  EXPECT_TRUE(harness->warnings(0.5).empty());
}

TEST_F(SilentStreams, AreNotReportedAtTheEnd) {
  for (const Side ended : {Side::kLeft, Side::kRight}) {
    start(kShort, true);
    harness->end(ended);
    EXPECT_TRUE(harness->warnings(0.5).empty());
  }
}

TEST_F(SilentStreams, AreNotReportedInPaused) {
  start(kShort, true);
  gst_element_set_state(harness->element(), GST_STATE_PAUSED);
  EXPECT_TRUE(harness->warnings(0.5).empty());
  gst_element_set_state(harness->element(), GST_STATE_PLAYING);
  EXPECT_NE(harness->warning().text, "");
}

TEST_F(SilentStreams, AreNotReportedWithoutATimeout) {
  start("max-disparity=16 timeout=0", true);
  EXPECT_TRUE(harness->warnings(0.5).empty());
}

TEST_F(SilentStreams, OfFilesAreNotReported) {
  start();
  EXPECT_TRUE(harness->warnings(0.5).empty());
}

TEST_F(SilentStreams, ThatNoDecoderHasLinkedYetAreReportedIfASourceIsLive) {
  for (const bool live : {true, false}) {
    Pipeline pipeline(std::string("mtstereo ") + kShort +
                      " ! fakesink async=false appsrc is-live=" + (live ? "true" : "false") +
                      " ! fakesink async=false");
    pipeline.set_state(GST_STATE_PLAYING);
    EXPECT_EQ(warning_of(pipeline, live ? 20 : 0.5).empty(), !live);
  }
}

// Feature: a pad that is not linked or silent is reported
TEST(UnlinkedPad, IsAnErrorThatNamesThePad) {
  for (const std::string linked : {"sink_left", "sink_right"}) {
    const std::string other = linked == "sink_left" ? "sink_right" : "sink_left";
    Pipeline pipeline("videotestsrc ! video/x-raw,format=GRAY8 ! m." + linked +
                      " mtstereo name=m timeout=100000000 ! fakesink");
    const std::string error = pipeline.run();
    EXPECT_NE(error.find(other + " is not linked"), std::string::npos) << error;
    EXPECT_NE(error.find("NAME." + other), std::string::npos) << error;
  }
}

TEST(UnlinkedPad, OfALivePipelineIsNamedInTheWarningOfLostFrames) {
  Pipeline pipeline(
      "videotestsrc is-live=true ! video/x-raw,format=GRAY8,framerate=100/1 ! queue ! m.sink_left "
      "mtstereo name=m ! fakesink");
  pipeline.set_state(GST_STATE_PLAYING);
  const std::string text = warning_of(pipeline, 20);
  EXPECT_NE(text.find("sink_right is not linked"), std::string::npos) << text;
  EXPECT_NE(text.find("NAME.sink_right"), std::string::npos) << text;
}

TEST(UnlinkedPad, OfTheMapsIsNamedInAWarning) {
  const std::string source = "videotestsrc ! video/x-raw,format=GRAY8 ! queue ! m.sink_";
  Pipeline pipeline("mtstereo name=m alignment=off " + source + "left " + source + "right");
  pipeline.set_state(GST_STATE_PLAYING);
  const std::string text = warning_of(pipeline, 20);
  EXPECT_NE(text.find("src is not linked"), std::string::npos) << text;
}

TEST(UnlinkedPad, EndsTheOtherStream) {
  Pipeline pipeline(
      "videotestsrc ! video/x-raw,format=GRAY8 ! m.sink_left mtstereo name=m "
      "timeout=100000000 ! fakesink async=false");
  EXPECT_NE(pipeline.run().find("sink_right is not linked"), std::string::npos);
  std::vector<std::string> ends{pipeline.wait_for_end(5), pipeline.wait_for_end(5)};
  std::sort(ends.begin(), ends.end());
  EXPECT_EQ(ends[0], "") << "of the sink";
  EXPECT_NE(ends[1].find("reason error"), std::string::npos) << ends[1] << ", of the source";
}

// Feature: a pad that is not linked or silent is reported
TEST(UnlinkedPad, DoesNotBlockTheEndThatIsSentToTheSources) {
  // gst-launch-1.0 -e sends it while the pipeline prerolls. A source takes it between two frames.
  Pipeline pipeline(
      "videotestsrc ! video/x-raw,format=GRAY8 ! m.sink_left mtstereo name=m timeout=300000000 ! "
      "fakesink");
  pipeline.set_state(GST_STATE_PAUSED);
  g_usleep(100'000);
  std::future<void> sent = std::async(
      std::launch::async, [&] { gst_element_send_event(pipeline.element(), gst_event_new_eos()); });
  EXPECT_NE(pipeline.wait_for_end(10).find("sink_right is not linked"), std::string::npos);
  EXPECT_EQ(sent.wait_for(std::chrono::seconds(10)), std::future_status::ready);
  pipeline.set_state(GST_STATE_NULL);
}

/// An mtstereo whose streams come from two appsrc, for frames at any time.
class PausedPipeline : public testing::Test {
 protected:
  PausedPipeline()
      : pipeline_(std::string("mtstereo name=m ") + kShort +
                  " ! fakesink appsrc name=left caps=" + raw_caps("GRAY8", kWidth, kHeight) +
                  " format=time ! m.sink_left appsrc name=right caps=" +
                  raw_caps("GRAY8", kWidth, kHeight) + " format=time ! m.sink_right") {}
  void push(const char* source, GstClockTime time) {
    const auto& image = source == std::string("left") ? pair_.left : pair_.right;
    gst_app_src_push_buffer(GST_APP_SRC(pipeline_.named(source)),
                            frame_buffer(image, time, kFrame));
  }
  bool warned(double seconds) { return !warning_of(pipeline_, seconds).empty(); }

  Pair pair_ = noise_pair(kWidth, kHeight, 5, 3);
  Pipeline pipeline_;
};

TEST_F(PausedPipeline, ThatWaitsForItsFirstPairReportsASilentPad) {
  pipeline_.set_state(GST_STATE_PAUSED);
  push("left", 0);
  EXPECT_TRUE(warned(20));
}

TEST_F(PausedPipeline, ThatHasItsFirstMapReportsNothing) {
  pipeline_.set_state(GST_STATE_PAUSED);
  push("left", 0);
  push("right", 0);
  ASSERT_TRUE(pipeline_.wait_until_settled());
  push("left", kFrame);
  EXPECT_FALSE(warned(0.4));
  pipeline_.set_state(GST_STATE_PLAYING);
  EXPECT_TRUE(warned(20));
}

TEST_F(PausedPipeline, ThatIsPausedWhileFramesWaitReportsNothing) {
  pipeline_.set_state(GST_STATE_PLAYING);
  push("left", 0);
  push("right", 0);
  ASSERT_TRUE(pipeline_.wait_until_settled());
  pipeline_.set_state(GST_STATE_PAUSED);
  push("left", kFrame);
  EXPECT_FALSE(warned(0.4));
}

/// An mtstereo whose maps a tee distributes; `first` and `second` are the branches. Waits for a
/// warning in this state: its text, "" if none comes.
std::string warning_of_branches(const std::string& first, const std::string& second, double seconds,
                                GstState state = GST_STATE_PAUSED, const char* live = "") {
  const std::string source =
      std::string("videotestsrc ") + live + " ! " + raw_caps("GRAY8", kWidth, kHeight);
  // Live streams whose first frame is late are reported, too.
  const char* const properties = live[0] == '\0' ? kShort : "max-disparity=16 timeout=500000000";
  Pipeline pipeline(std::string("mtstereo name=m alignment=off ") + properties +
                    " ! tee name=t t. ! " + first + " t. ! " + second + " " + source +
                    " ! m.sink_left " + source + " ! m.sink_right");
  pipeline.set_state(state);
  return warning_of(pipeline, seconds);
}

TEST(BlockedStart, OfATeeWithoutQueuesIsReportedWithTheRemedy) {
  for (const char* live : {"", "is-live=true"}) {
    const std::string text =
        warning_of_branches("fakesink", "mtcolor ! fakesink", 20, GST_STATE_PLAYING, live);
    EXPECT_NE(text.find("does not start"), std::string::npos) << text;
    EXPECT_NE(text.find("queue in each branch"), std::string::npos) << text;
  }
}

TEST(BlockedStart, IsNotReportedIfAllSinksHaveData) {
  for (const GstState state : {GST_STATE_PAUSED, GST_STATE_PLAYING}) {
    EXPECT_EQ(warning_of_branches("queue ! fakesink", "queue ! fakesink", 0.5, state), "");
    EXPECT_EQ(warning_of_branches("fakesink", "fakesink async=false", 0.5, state), "");
  }
}

TEST(Watchdog, IsSafeAgainstStateChangesAndTheEndOfTheElement) {
  for (int i = 0; i < 40; ++i) {
    StereoHarness harness("max-disparity=16 timeout=1000");
    harness.caps(raw_caps("GRAY8", kWidth, kHeight));
    const Pair pair = noise_pair(kWidth, kHeight, 5, 3);
    harness.push(Side::kLeft, frame_buffer(pair.left, 0, kFrame));
    for (const GstState state : {GST_STATE_PAUSED, GST_STATE_READY, GST_STATE_PLAYING}) {
      g_usleep(static_cast<gulong>(i * 97 % 3000));
      gst_element_set_state(harness.element(), state);
    }
    g_usleep(static_cast<gulong>(4500 + i * 31 % 1000));  // the timer runs every 5 ms
  }
}

}  // namespace
}  // namespace mtstereo::test::watchdog_test
