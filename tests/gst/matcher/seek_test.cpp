// SPDX-License-Identifier: LGPL-2.1-or-later
// Seeks in two files whose key frames and lengths differ: no pair is wrong.
#include <gtest/gtest.h>

#include <memory>

#include "support/file_player.hpp"

namespace mtstereo::test::seek_test {
namespace {

constexpr int kLeftFrames = NumberedFiles::kLeftFrames;
constexpr int kRightFrames = NumberedFiles::kRightFrames;

class Seeks : public testing::TestWithParam<Container> {
 protected:
  static void SetUpTestSuite() {
    if (missing_element().empty()) files_ = std::make_unique<NumberedFiles>();
  }
  static void TearDownTestSuite() { files_.reset(); }
  void SetUp() override {
    if (!files_) GTEST_SKIP() << "there is no " << missing_element();
    player = std::make_unique<FilePlayer>(*files_, GetParam());
  }
  /// All seeks of a list, each to the end of the segment.
  void play(const std::vector<Seek>& seeks) {
    for (const Seek& seek : seeks) {
      const DifferenceCounter count = player->play(seek);
      const int end = std::min(seek.to < 0 ? kRightFrames : seek.to, kRightFrames);
      // In reverse some demuxers begin at a key frame.
      const bool key_frames = seek.rate < 0 && (seek.flags & GST_SEEK_FLAG_KEY_UNIT) != 0;
      const int least = key_frames ? 30 : end - seek.from - 1;
      const auto text = seek_text(seek) + ": " + std::to_string(count.maps) + " maps";
      EXPECT_EQ(count.wrong, 0) << text;
      EXPECT_EQ(count.unknown, 0) << text;
      EXPECT_GE(count.maps, least) << text;
    }
  }

  std::unique_ptr<FilePlayer> player;

 private:
  static inline std::unique_ptr<NumberedFiles> files_;
};

TEST_P(Seeks, ToKeyFrames) {
  const int flags = GST_SEEK_FLAG_KEY_UNIT;
  play({{1, flags, 5},
        {1, flags, 16},
        {1, flags, 20},
        {1, flags, 44},
        {1, flags, 31},
        {1, flags, 50},
        {1, flags, 0},
        {1, flags | GST_SEEK_FLAG_SNAP_BEFORE, 38}});
}

TEST_P(Seeks, ToTheNearestOrNextKeyFrame) {
  for (const int snap : {GST_SEEK_FLAG_SNAP_AFTER, GST_SEEK_FLAG_SNAP_NEAREST}) {
    for (const int from : {3, 12, 20, 33, 38}) {
      const Seek seek = {1, GST_SEEK_FLAG_KEY_UNIT | snap, from};
      const DifferenceCounter count = player->play(seek);
      EXPECT_EQ(count.wrong + count.unknown, 0) << "frame " << from << ", flags " << snap;
      EXPECT_GE(count.maps, kRightFrames - 45 - 1) << "frame " << from << ", flags " << snap;
    }
  }
}

TEST_P(Seeks, WhilePlaying) {
  for (int i = 0; i < 12; ++i) {
    const int flags = i % 3 == 2 ? GST_SEEK_FLAG_ACCURATE : GST_SEEK_FLAG_KEY_UNIT;
    const int from = i * 17 % 48;
    const DifferenceCounter count = player->play({i % 4 == 3 ? 2.0 : 1.0, flags, from}, 3);
    EXPECT_EQ(count.wrong + count.unknown, 0) << "seek " << i << " to frame " << from;
    EXPECT_GE(count.maps, 3) << "seek " << i << " to frame " << from;
  }
}

TEST_P(Seeks, WithoutAFlush) {
  // Each stream plays a few more frames of the old segment than the other one. The end of the files
  // is far, as a stream that has ended does not seek without a flush.
  for (int i = 0; i < 12; ++i) {
    const int from = i * 17 % 40;
    const int flags = i % 2 == 0 ? GST_SEEK_FLAG_KEY_UNIT : GST_SEEK_FLAG_ACCURATE;
    player->play({.from = from / 4}, 4 + i % 3);
    const DifferenceCounter count = player->play(
        {.rate = i % 4 == 3 ? 2.0 : 1.0, .flags = flags, .from = from, .flush = false}, 15);
    EXPECT_EQ(count.wrong + count.unknown, 0) << "seek " << i << " to frame " << from;
    EXPECT_GE(count.maps, 10) << "seek " << i << " to frame " << from;
  }
}

// Feature: seeks
TEST_P(Seeks, ToExactPositions) {
  const int flags = GST_SEEK_FLAG_ACCURATE;
  play({{1, flags, 0}, {1, flags, 7}, {1, flags, 16}, {1, flags, 41}, {1, flags, 52}});
}

TEST_P(Seeks, OfSegments) {
  for (const int kind : {GST_SEEK_FLAG_ACCURATE, GST_SEEK_FLAG_KEY_UNIT}) {
    const int flags = kind | GST_SEEK_FLAG_SEGMENT;
    play({{1, flags, 4, 30}, {1, flags, 20, 50}, {1, flags, 42, 55}});
  }
}

// Feature: seeks
TEST_P(Seeks, AtDoubleRate) {
  for (const int flags : {GST_SEEK_FLAG_ACCURATE, GST_SEEK_FLAG_KEY_UNIT}) {
    play({{2, flags, 0}, {2, flags, 20}, {2, flags, 44}, {0.5, flags, 33}});
  }
}

// Feature: seeks
TEST_P(Seeks, Backward) {
  for (const int flags : {0, int{GST_SEEK_FLAG_ACCURATE}, int{GST_SEEK_FLAG_KEY_UNIT}}) {
    play({{-1, flags, 0, kLeftFrames}, {-1, flags, 0}, {-1, flags, 0, 50}, {-2, flags, 0, 33}});
  }
}

INSTANTIATE_TEST_SUITE_P(Files, Seeks, testing::Values(kMatroska, kMp4),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace mtstereo::test::seek_test
