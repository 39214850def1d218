// SPDX-License-Identifier: LGPL-2.1-or-later
// Caps that arrive late and caps that change.
#include <gtest/gtest.h>

#include "support/stereo_harness.hpp"

namespace mtstereo::test::renegotiation_test {
namespace {

void expect_library_map(StereoHarness& harness, const Pair& pair) {
  Parameters parameters;
  ASSERT_TRUE(parameters.set(Parameter::kMaxDisparity, 16).ok());
  const BufferPointer map = harness.pull();
  ASSERT_TRUE(map) << harness.error(1).text;
  EXPECT_EQ(first_difference(library_map(pair, parameters, 256),
                             map_of(map.get(), pair.left.width, pair.left.height), pair.left.width),
            "");
}

TEST(Renegotiation, CapsMayArriveAfterFramesOfTheOtherSide) {
  const Pair pair = noise_pair(64, 48, 4, 1);
  for (const Side first : {Side::kLeft, Side::kRight}) {
    StereoHarness harness;
    for (const Side side : {first, first == Side::kLeft ? Side::kRight : Side::kLeft}) {
      harness.caps(side, raw_caps("GRAY8", 64, 48));
      harness.push(side, frame_buffer(side == Side::kLeft ? pair.left : pair.right, 0, kFrame));
      EXPECT_TRUE(side != first || harness.silent());
    }
    expect_library_map(harness, pair);
  }
}

// Feature: the size may change while playing
TEST(Renegotiation, TheSizeMayChangeOnBothSides) {
  StereoHarness harness;
  GstClockTime time = 0;
  for (const auto& [width, height] : {std::pair(64, 48), {97, 31}, {128, 96}, {64, 48}}) {
    const Pair pair = noise_pair(width, height, 4, 2);
    harness.caps(raw_caps("GRAY8", width, height));
    for (int i = 0; i < 2; ++i, time += kFrame) {
      harness.push_pair(pair, time);
      expect_library_map(harness, pair);
    }
    GstVideoInfo info;
    ASSERT_TRUE(gst_video_info_from_caps(&info, harness.output_caps().get()));
    EXPECT_EQ(info.width, width);
    EXPECT_EQ(info.height, height);
  }
  EXPECT_EQ(harness.further_errors(), 0);
}

// Feature: the size may change while playing
TEST(Renegotiation, FramesOfTheOldAndTheNewSizeAreNotPaired) {
  StereoHarness harness;
  const Pair old_pair = noise_pair(64, 48, 4, 3);
  const Pair new_pair = noise_pair(96, 64, 4, 3);
  harness.caps(raw_caps("GRAY8", 64, 48));
  harness.push_pair(old_pair, 0);
  ASSERT_TRUE(harness.pull());
  // The last left frame of the old size is lost.
  harness.push(Side::kRight, frame_buffer(old_pair.right, kFrame, kFrame));
  harness.caps(Side::kLeft, raw_caps("GRAY8", 96, 64));
  harness.push(Side::kLeft, frame_buffer(new_pair.left, 2 * kFrame, kFrame));
  harness.caps(Side::kRight, raw_caps("GRAY8", 96, 64));
  harness.push(Side::kRight, frame_buffer(new_pair.right, 2 * kFrame, kFrame));
  expect_library_map(harness, new_pair);
  EXPECT_TRUE(harness.wait_for_stats(2, 0, 1));
  EXPECT_EQ(harness.further_errors(), 0);
}

// Feature: the streams may differ in framerate and other caps
TEST(Renegotiation, TheFormatMayChangeOnOneSide) {
  StereoHarness harness;
  const Pair pair = noise_pair(64, 48, 4, 4);
  harness.caps(raw_caps("GRAY8", 64, 48));
  harness.push_pair(pair, 0);
  expect_library_map(harness, pair);
  harness.caps(Side::kRight, raw_caps("NV12", 64, 48));
  harness.push_pair(pair, kFrame, {}, {.format = "NV12", .poison = 9});
  expect_library_map(harness, pair);
}

// Feature: different sizes are rejected
TEST(Renegotiation, ReportsASizeThatChangesOnOneSideOnly) {
  StereoHarness harness;
  harness.caps(raw_caps("GRAY8", 64, 48));
  harness.push_pair(noise_pair(64, 48, 4, 5), 0);
  ASSERT_TRUE(harness.pull());
  harness.caps(Side::kRight, raw_caps("GRAY8", 80, 48));
  harness.push(Side::kLeft, frame_buffer(noise_pair(64, 48, 4, 5).left, kFrame, kFrame));
  harness.push(Side::kRight, frame_buffer(noise_pair(80, 48, 4, 5).right, kFrame, kFrame));
  const Report error = harness.error();
  EXPECT_NE(error.text.find("left 64x48, right 80x48"), std::string::npos) << error.text;
  EXPECT_EQ(harness.further_errors(), 0);
}

// Feature: the size may change while playing
TEST(Renegotiation, OutputCapsFollowTheScale) {
  StereoHarness harness;
  const Pair pair = noise_pair(64, 48, 4, 6);
  harness.caps(raw_caps("GRAY8", 64, 48));
  harness.push_pair(pair, 0);
  ASSERT_TRUE(harness.pull());
  g_object_set(harness.element(), "disparity-scale", 100, nullptr);
  harness.push_pair(pair, kFrame);
  const BufferPointer map = harness.pull();
  ASSERT_TRUE(map);
  int scale = 0;
  const CapsPointer caps = harness.output_caps();
  gst_structure_get_int(gst_caps_get_structure(caps.get(), 0), "disparity-scale", &scale);
  EXPECT_EQ(scale, 100);
  Parameters parameters;
  ASSERT_TRUE(parameters.set(Parameter::kMaxDisparity, 16).ok());
  EXPECT_EQ(first_difference(library_map(pair, parameters, 100), map_of(map.get(), 64, 48), 64),
            "");
}

}  // namespace
}  // namespace mtstereo::test::renegotiation_test
