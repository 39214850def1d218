// SPDX-License-Identifier: LGPL-2.1-or-later
// What GST_DEBUG=mtstereo:5 shows.
#include "support/debug_log.hpp"

#include <gtest/gtest.h>

#include "support/map_harness.hpp"
#include "support/numbered_views.hpp"

namespace mtstereo::test::debug_log_test {
namespace {

void play(int frames, const FeedOptions& options = {}) {
  const FeedResult result =
      feed(numbered_sequence(frames, kFrame, kFrame),
           numbered_sequence(frames, kFrame, kFrame + 4 * GST_MSECOND), options);
  EXPECT_EQ(result.error, "");
  EXPECT_GE(result.count.maps, frames - 2);
}

// Feature: errors as messages with a remedy, no output on stdout
TEST(DebugLog, ShowsCapsSettingsOffsetAndLatency) {
  DebugLog log(GST_LEVEL_DEBUG);
  play(30);
  EXPECT_EQ(log.lines_with("caps video/x-raw, format=(string)GRAY8"), 2);
  EXPECT_EQ(log.lines_with("maps video/x-raw, format=(string)GRAY16_LE"), 1);
  EXPECT_EQ(log.lines_with("settings in effect: preset=default mode=semi-dense"), 1);
  EXPECT_GE(log.lines_with("max-disparity=64"), 1);
  EXPECT_GE(log.lines_with("the right frames are 4.00 ms after the left ones"), 1);
  EXPECT_GE(log.lines_with("waits 33.33 ms for a partner"), 1);
}

TEST(DebugLog, ShowsTheMatchingTimeOfLiveStreams) {
  DebugLog log(GST_LEVEL_DEBUG);
  FeedOptions options;
  options.live = true;
  play(8, options);
  EXPECT_GE(log.lines_with("matching time"), 1);
}

TEST(DebugLog, HasNoLineForEachFrame) {
  DebugLog log(GST_LEVEL_DEBUG);
  play(20);
  const int few = log.lines();
  play(120);
  EXPECT_LE(log.lines() - few, few + 6);
}

TEST(DebugLog, HasALineForEachFrameAtLevelLog) {
  DebugLog log(GST_LEVEL_LOG);
  play(20);
  EXPECT_GE(log.lines_with("matched"), 18);
}

TEST(DebugLog, StatesAScaleThatWasChosen) {
  DebugLog log(GST_LEVEL_INFO);
  StereoHarness harness("max-disparity=300");
  harness.caps(raw_caps("GRAY8", 320, 40));
  harness.push_pair(noise_pair(320, 40, 4, 1), 0);
  EXPECT_TRUE(harness.pull());
  EXPECT_EQ(log.lines(), 1);
  EXPECT_EQ(log.lines_with("disparity-scale=128, with which max-disparity=300 fits"), 1);
}

TEST(DebugLog, StatesWhatTheCamerasOfDepthsMeasure) {
  DebugLog log(GST_LEVEL_INFO, "mtdepth");
  MapHarness harness("mtdepth", "focal-length=100 baseline=0.1");
  harness.caps(200, 100, ",disparity-scale=256,max-disparity=20");
  ASSERT_TRUE(harness.pass(map_buffer(Map16{200, 100, std::vector<std::uint16_t>(20000, 512)})));
  EXPECT_EQ(
      log.lines_with("focal length 100.0 px, baseline 0.100 m, field of view 90 x 53 degrees, "
                     "measures from 0.500 m (20 px) to 10.0 m (1 px)"),
      1);
}

}  // namespace
}  // namespace mtstereo::test::debug_log_test
