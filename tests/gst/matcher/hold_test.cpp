// SPDX-License-Identifier: LGPL-2.1-or-later
// temporal=hold and filter: when a map does not depend on the pairs before.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "support/stereo_harness.hpp"

namespace mtstereo::test::hold_test {
namespace {

constexpr int kWidth = 160, kHeight = 96;

/// The noisy frames of a camera at rest.
Pair frame(unsigned number, unsigned scene = 1) {
  Pair pair = noise_pair(kWidth, kHeight, 6, scene);
  std::mt19937 random(number);
  for (GrayImage* view : {&pair.left, &pair.right}) {
    for (std::uint8_t& pixel : view->pixels) {
      const int noise = static_cast<int>(random() % 15 + random() % 15) - 14;
      pixel = static_cast<std::uint8_t>(std::clamp(pixel + noise, 0, 255));
    }
  }
  return pair;
}

Parameters parameters() {
  Parameters parameters;
  EXPECT_TRUE(parameters.set(Parameter::kMaxDisparity, 16).ok());
  return parameters;
}

/// The map of a frame that does not depend on another one.
std::vector<std::uint16_t> alone(const Pair& pair) { return library_map(pair, parameters(), 256); }

/// A running element, after some frames of a stream.
class HoldElement : public testing::Test {
 protected:
  explicit HoldElement(const std::string& temporal = "hold")
      : harness("max-disparity=16 alignment=off temporal=" + temporal) {
    harness.caps(raw_caps("GRAY8", kWidth, kHeight));
    EXPECT_EQ(alone(frame(0)), next(frame(0), 0)) << "the first pair";
    for (int i = 1; i < 4; ++i) next(frame(i), i * kFrame);
  }

  std::vector<std::uint16_t> next(const Pair& pair, GstClockTime time, bool discontinuous = false,
                                  Side flagged = Side::kLeft) {
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const GrayImage& view = side == Side::kLeft ? pair.left : pair.right;
      GstBuffer* buffer = frame_buffer(view, time, kFrame);
      if (discontinuous && side == flagged) GST_BUFFER_FLAG_SET(buffer, GST_BUFFER_FLAG_DISCONT);
      harness.push(side, buffer);
    }
    const BufferPointer map = harness.pull();
    EXPECT_TRUE(map) << harness.error(1).text;
    return map ? map_of(map.get(), kWidth, kHeight) : std::vector<std::uint16_t>();
  }
  /// Whether the map of a frame at this time depends on the last one.
  bool is_held(GstClockTime time) { return next(frame(9), time) != alone(frame(9)); }

  StereoHarness harness;
};

class FilterElement : public HoldElement {
 protected:
  FilterElement() : HoldElement("filter") {}
};

TEST_F(FilterElement, BeginsAnewAsHoldDoes) {
  EXPECT_TRUE(is_held(4 * kFrame));
  EXPECT_EQ(alone(frame(6)), next(frame(6), 5 * kFrame, true));
  EXPECT_TRUE(is_held(6 * kFrame));
  EXPECT_FALSE(is_held(7 * kFrame + GST_SECOND)) << "a gap";
  next(frame(6), 7 * kFrame + GST_SECOND + kFrame / 2);
  EXPECT_TRUE(is_held(8 * kFrame + GST_SECOND));
  const Pair other = frame(9, 2);
  EXPECT_EQ(alone(other), next(other, 9 * kFrame + GST_SECOND)) << "a cut";
  harness.flush(1234);
  EXPECT_FALSE(is_held(0));
}

TEST_F(HoldElement, DependsOnTheLastPair) { EXPECT_TRUE(is_held(4 * kFrame)); }

TEST_F(HoldElement, SurvivesLostFrames) { EXPECT_TRUE(is_held(8 * kFrame)); }

TEST_F(HoldElement, SurvivesSkippedFramesOfHalfASecond) {
  EXPECT_TRUE(is_held(3 * kFrame + GST_SECOND / 2));
}

TEST_F(HoldElement, BeginsAnewAfterALongerGap) {
  EXPECT_FALSE(is_held(3 * kFrame + GST_SECOND / 2 + 1));
}

TEST_F(HoldElement, BeginsAnewAfterMoreThanFiveFramesOfASlowStream) {
  for (const Side side : {Side::kLeft, Side::kRight}) {
    harness.caps(side, raw_caps("GRAY8", kWidth, kHeight, "2/1"));
  }
  next(frame(5), GST_SECOND);
  EXPECT_TRUE(is_held(GST_SECOND + 5 * GST_SECOND / 2));
  EXPECT_FALSE(is_held(GST_SECOND + 5 * GST_SECOND + 1));
}

// Feature: steady maps of still scenes, and before a moving camera
TEST_F(HoldElement, BeginsAnewAfterADiscontinuity) {
  GstClockTime time = 4 * kFrame;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    next(frame(5), time);
    EXPECT_EQ(alone(frame(9)), next(frame(9), time + kFrame, true, side));
    time += 2 * kFrame;
  }
}

TEST_F(HoldElement, BeginsAnewAfterAFlush) {
  harness.flush(1234);
  EXPECT_FALSE(is_held(4 * kFrame));
}

TEST_F(HoldElement, BeginsAnewWithANewSegment) {
  harness.segment();
  EXPECT_FALSE(is_held(4 * kFrame));
}

TEST_F(HoldElement, BeginsAnewWithOtherCaps) {
  harness.caps(raw_caps("GRAY8", kWidth, kHeight, "25/1"));
  EXPECT_FALSE(is_held(4 * kFrame));
}

TEST_F(HoldElement, BeginsAnewWithOtherParameters) {
  for (const char* const least : {"100", "134"}) {
    gst_util_set_object_arg(G_OBJECT(harness.element()), "min-confidence", least);
    if (least == std::string("100")) next(frame(8), 4 * kFrame);
  }
  EXPECT_FALSE(is_held(5 * kFrame));
}

TEST_F(HoldElement, GoesOnWhenOtherPropertiesChange) {
  g_object_set(harness.element(), "alignment-interval", 7, nullptr);
  EXPECT_TRUE(is_held(4 * kFrame));
}

TEST_F(HoldElement, BeginsAnewAfterACut) {
  const Pair other = frame(9, 2);
  EXPECT_EQ(alone(other), next(other, 4 * kFrame));
}

TEST_F(HoldElement, CanBeSwitchedOffAndOn) {
  gst_util_set_object_arg(G_OBJECT(harness.element()), "temporal", "off");
  EXPECT_FALSE(is_held(4 * kFrame));
  gst_util_set_object_arg(G_OBJECT(harness.element()), "temporal", "hold");
  EXPECT_FALSE(is_held(5 * kFrame));
  for (int i = 0; i < 4; ++i) next(frame(i), (6 + i) * kFrame);
  EXPECT_TRUE(is_held(10 * kFrame));
}

}  // namespace
}  // namespace mtstereo::test::hold_test
