// SPDX-License-Identifier: LGPL-2.1-or-later
// Feature: two recorders that were started apart
#include "recordings/clocks/frame_pairs.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mtstereo::run::frame_pairs_test {
namespace {

constexpr Nanoseconds kMillisecond = 1'000'000;

// Frames at a constant rate; their times are rounded to this unit.
FrameIndex frames(int count, double rate, double start = 0, Nanoseconds unit = 1) {
  FrameIndex index;
  for (int i = 0; i < count; ++i) {
    const double time = 1e9 * (start + i / rate);
    index.times.push_back(std::llround(time / static_cast<double>(unit)) * unit);
  }
  index.period = std::llround(1e9 / rate);
  return index;
}

TEST(PairFrames, PairsEqualTimes) {
  const PairList list = pair_frames(frames(100, 30), frames(90, 30), {}, std::nullopt);
  ASSERT_EQ(list.pairs.size(), 90U);
  for (int i = 0; i < 90; ++i) EXPECT_EQ(list.pairs[i], (FramePair{i, i}));
  EXPECT_EQ(list.dropped_left, 10);
  EXPECT_EQ(list.dropped_right, 0);
}

TEST(PairFrames, AppliesOffsetAndDrift) {
  // The right recorder started 7.01 s later, and its clock gains a frame in 111 s.
  const ClockRelation relation{-7.01, 300e-6};
  const PairList list = pair_frames(frames(9000, 30), frames(9000, 30), relation, std::nullopt);
  ASSERT_GT(list.pairs.size(), 8700U);
  for (const FramePair& pair : list.pairs) {
    const double left = static_cast<double>(pair.left) / 30;
    const double right = static_cast<double>(pair.right) / 30;
    EXPECT_LE(std::abs(left * (1 + relation.drift) + relation.offset - right), 0.57 / 30);
  }
  for (std::size_t i = 1; i < list.pairs.size(); ++i) {
    ASSERT_GT(list.pairs[i].left, list.pairs[i - 1].left);
    ASSERT_GT(list.pairs[i].right, list.pairs[i - 1].right);
  }
  // Every frame of the overlap has a partner, but one each time the clock has gained a frame.
  EXPECT_LE(list.dropped_left - list.pairs.front().left, 3);
}

TEST(PairFrames, KeepsAllFramesHalfAFrameApartWithTimesInMilliseconds) {
  const PairList list = pair_frames(frames(1000, 30, 0, kMillisecond),
                                    frames(1000, 30, 0.5 / 30, kMillisecond), {}, std::nullopt);
  ASSERT_GE(list.pairs.size(), 999U);
  const auto shift = list.pairs.front().right - list.pairs.front().left;
  for (const FramePair& pair : list.pairs) EXPECT_EQ(pair.right - pair.left, shift);
}

TEST(PairFrames, DropsThePartnerOfALostFrame) {
  FrameIndex right = frames(50, 30);
  right.times.erase(right.times.begin() + 20);
  const PairList list = pair_frames(frames(50, 30), right, {}, std::nullopt);
  ASSERT_EQ(list.pairs.size(), 49U);
  EXPECT_EQ(list.pairs[19], (FramePair{19, 19}));
  EXPECT_EQ(list.pairs[20], (FramePair{21, 20}));
  EXPECT_EQ(list.dropped_left, 1);
}

TEST(PairFrames, PairsTheSlowerSourceWithTheNearestFramesOfTheFasterOne) {
  const PairList list = pair_frames(frames(30, 30), frames(60, 60), {}, std::nullopt);
  ASSERT_EQ(list.pairs.size(), 30U);
  for (int i = 0; i < 30; ++i) EXPECT_EQ(list.pairs[i], (FramePair{i, 2 * i}));
  EXPECT_EQ(list.dropped_right, 30);
}

TEST(PairFrames, RespectsTheTolerance) {
  const FrameIndex left = frames(30, 30), right = frames(30, 30, 0.010);
  EXPECT_EQ(pair_frames(left, right, {}, 10 * kMillisecond).pairs.size(), 30U);
  EXPECT_TRUE(pair_frames(left, right, {}, 9 * kMillisecond).pairs.empty());
}

TEST(PairFrames, GivesNothingForRecordingsWithoutOverlap) {
  const PairList list = pair_frames(frames(30, 30), frames(30, 30, 5), {}, std::nullopt);
  EXPECT_TRUE(list.pairs.empty());
  EXPECT_EQ(list.dropped_left, 30);
  EXPECT_EQ(list.dropped_right, 30);
}

TEST(AllFrames, PairsEveryFrameWithItself) {
  const PairList list = all_frames(frames(5, 30));
  ASSERT_EQ(list.pairs.size(), 5U);
  EXPECT_EQ(list.pairs[4], (FramePair{4, 4}));
  EXPECT_EQ(list.dropped_left + list.dropped_right, 0);
}

}  // namespace
}  // namespace mtstereo::run::frame_pairs_test
