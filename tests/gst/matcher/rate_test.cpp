// SPDX-License-Identifier: LGPL-2.1-or-later
// Seeks at every rate, with and without trick modes and lost frames: no pair is wrong.
#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <ostream>
#include <thread>

#include "support/file_player.hpp"

namespace mtstereo::test::rate_test {
namespace {

constexpr int kFrames = NumberedFiles::kRightFrames;

/// A kind of playing, and the least share of the frames that it must show.
struct Mode {
  const char* name;
  int flags;
  double least;
};

void PrintTo(const Mode& mode, std::ostream* stream) { *stream << mode.name; }

class Rates : public testing::TestWithParam<Mode> {
 protected:
  static void SetUpTestSuite() {
    if (missing_element().empty()) files_ = std::make_unique<NumberedFiles>();
  }
  static void TearDownTestSuite() { files_.reset(); }
  void SetUp() override {
    if (!files_) GTEST_SKIP() << "there is no " << missing_element();
    player = std::make_unique<FilePlayer>(*files_, kMatroska);
  }
  void play_at(double rate, double loss) {
    const Seek seek = {.rate = rate, .flags = GetParam().flags};
    const DifferenceCounter count = player->play(seek);
    const std::string text = seek_text(seek) + ", loss " + std::to_string(loss) + ": " +
                             std::to_string(count.maps) + " maps";
    EXPECT_EQ(count.wrong, 0) << text;
    EXPECT_EQ(count.unknown, 0) << text;
    EXPECT_GE(count.maps, static_cast<int>(GetParam().least * (0.95 - 1.3 * loss) * kFrames))
        << text;
    EXPECT_FALSE(GetParam().least > 0 && player->warned()) << text;
  }

  std::unique_ptr<FilePlayer> player;

 private:
  static inline std::unique_ptr<NumberedFiles> files_;
};

TEST_P(Rates, PairTheSameFrames) {
  for (const double loss : {0.0, 0.3}) {
    for (const double rate : {0.5, 1.0, 2.0, 3.0, 4.0, 8.0, 16.0, -0.5, -1.0, -2.0, -4.0, -8.0}) {
      player->lose(rate == 4 || rate == -8 ? Side::kLeft : Side::kRight, loss);
      play_at(rate, loss);
    }
    player->lose(Side::kLeft, 0);
  }
}

TEST_P(Rates, PairNoNeighborsWithALargeTolerance) {
  g_object_set(player->matcher(), "sync-tolerance", gint64{100} * GST_MSECOND, nullptr);
  player->lose(Side::kLeft, 0.3);
  for (const double rate : {1.0, 4.0, 16.0, -4.0}) play_at(rate, 0.3);
}

const Mode kPlain = {"Plain", 0, 1};
const Mode kTrickmode = {"Trickmode", GST_SEEK_FLAG_TRICKMODE, 1};
const Mode kKeyUnits = {"KeyUnits", GST_SEEK_FLAG_TRICKMODE_KEY_UNITS, 0};

INSTANTIATE_TEST_SUITE_P(Modes, Rates, testing::Values(kPlain, kTrickmode, kKeyUnits),
                         [](const auto& info) { return info.param.name; });

/// The key frames of streams with a skew have no partners.
class Skew : public Rates {};

TEST_P(Skew, IsThatOfTheCamerasAtEveryRate) {
  player->delay_right(2);
  for (const double rate : {0.5, 1.0, 4.0, 16.0, -1.0, -4.0}) play_at(rate, 0);
}

INSTANTIATE_TEST_SUITE_P(Modes, Skew, testing::Values(kPlain, kTrickmode),
                         [](const auto& info) { return info.param.name; });

/// A source plays at a rate by itself: the time stamps count its output.
TEST(AppliedRate, PairsTheSameFrames) {
  for (const int rate : {1, 4, -8}) {
    StereoHarness harness(kNumberedMatching);
    harness.caps(raw_caps("GRAY8", kNumberedWidth, kNumberedHeight));
    GstSegment segment = time_segment();
    segment.applied_rate = rate;
    harness.segment(segment);
    const auto push = [&](Side side, int lost) {
      for (int i = 0; i < 40; ++i) {
        const auto pts =
            static_cast<GstClockTime>(i) * kFrame / static_cast<unsigned>(std::abs(rate));
        if (i % 3 != lost) harness.push(side, numbered_frame(side, i, pts));
      }
      harness.end(side);
    };
    std::thread left([&] { push(Side::kLeft, 3); });
    push(Side::kRight, 1);
    left.join();
    DifferenceCounter count;
    while (count.maps < 27) {
      const BufferPointer map = harness.pull(5);
      ASSERT_TRUE(map) << "rate " << rate << ", after " << count.maps << " maps";
      count.add(frame_difference(map.get()));
    }
    EXPECT_EQ(count.wrong + count.unknown, 0) << "rate " << rate;
    EXPECT_TRUE(harness.silent()) << "rate " << rate;
  }
}

}  // namespace
}  // namespace mtstereo::test::rate_test
