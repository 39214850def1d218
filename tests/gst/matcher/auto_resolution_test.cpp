// SPDX-License-Identifier: LGPL-2.1-or-later
// resolution=auto: what `stats` and the log state, and when the choice begins anew.
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "support/debug_log.hpp"
#include "support/stereo_harness.hpp"

namespace mtstereo::test::auto_resolution_test {
namespace {

/// The element is tested as it is documented.
constexpr int kFrames = 5;
constexpr double kSoft = 0.08, kSharp = 0.095;
constexpr int kWidth = 160, kHeight = 96;

/// A pair of white noise at 5 px, smoothed along the rows if it is `soft`.
Pair pair_of_noise(bool soft) {
  constexpr std::array kWeights = {1, 6, 15, 20, 15, 6, 1};
  std::mt19937 random(1);
  std::vector<int> scene(kWidth + 11);
  Pair pair{{kWidth, kHeight, {}}, {kWidth, kHeight, {}}};
  for (int y = 0; y < kHeight; ++y) {
    for (int& value : scene) value = static_cast<int>(random() % 256);
    const auto at = [&](int x) {
      int sum = 0;
      for (int i = 0; i < 7; ++i) sum += kWeights[i] * scene[x + i];
      return static_cast<std::uint8_t>(soft ? sum / 64 : scene[x + 3]);
    };
    for (int x = 0; x < kWidth; ++x) {
      pair.left.pixels.push_back(at(x));
      pair.right.pixels.push_back(at(x + 5));
    }
  }
  return pair;
}

/// A running element at resolution=auto.
class AutoResolutionElement : public testing::Test {
 protected:
  AutoResolutionElement() { harness.caps(raw_caps("GRAY8", kWidth, kHeight)); }

  void match(bool soft, int frames) {
    for (int i = 0; i < frames; ++i) {
      harness.push_pair(soft ? soft_ : sharp_, next_++ * kFrame);
      ASSERT_TRUE(harness.pull()) << harness.error(1).text;
    }
  }
  bool is_half() {
    gboolean half = FALSE;
    EXPECT_TRUE(gst_structure_get_boolean(stats().get(), "half-resolution", &half));
    return half != FALSE;
  }
  double detail() {
    double detail = -1;
    EXPECT_TRUE(gst_structure_get_double(stats().get(), "fine-detail", &detail));
    return detail;
  }

  StereoHarness harness{"max-disparity=16 alignment=off resolution=auto"};

 private:
  StructurePointer stats() {
    GstStructure* stats = nullptr;
    g_object_get(harness.element(), "stats", &stats, nullptr);
    return StructurePointer(stats);
  }

  Pair soft_ = pair_of_noise(true), sharp_ = pair_of_noise(false);
  GstClockTime next_ = 0;
};

TEST_F(AutoResolutionElement, StatisticsHaveTheResolutionAndTheDetail) {
  match(true, kFrames);
  EXPECT_FALSE(is_half());
  EXPECT_GT(detail(), 0);
  EXPECT_LE(detail(), kSoft);
  match(true, 1);
  EXPECT_TRUE(is_half());
  match(false, kFrames);
  EXPECT_TRUE(is_half());
  EXPECT_GE(detail(), kSharp);
  match(false, 1);
  EXPECT_FALSE(is_half());
}

TEST_F(AutoResolutionElement, LogsEachChangeOnce) {
  DebugLog log(GST_LEVEL_INFO);
  match(true, 3 * kFrames);
  EXPECT_EQ(log.lines_with("matched at half resolution"), 1);
  EXPECT_EQ(log.lines_with("matched at full resolution"), 0);
  match(false, 3 * kFrames);
  EXPECT_EQ(log.lines_with("matched at half resolution"), 1);
  EXPECT_EQ(log.lines_with("matched at full resolution"), 1);
}

TEST_F(AutoResolutionElement, BeginsAnewAfterAFlush) {
  match(true, kFrames + 1);
  ASSERT_TRUE(is_half());
  harness.flush(1234);
  match(true, 1);
  EXPECT_FALSE(is_half());
  match(true, kFrames);
  EXPECT_TRUE(is_half());
}

TEST_F(AutoResolutionElement, BeginsAnewWithANewSegment) {
  match(true, kFrames + 1);
  ASSERT_TRUE(is_half());
  harness.segment();
  match(true, 1);
  EXPECT_FALSE(is_half());
}

TEST_F(AutoResolutionElement, CanBeSetWhilePlaying) {
  DebugLog log(GST_LEVEL_INFO);
  match(true, kFrames + 1);
  ASSERT_TRUE(is_half());
  gst_util_set_object_arg(G_OBJECT(harness.element()), "resolution", "full");
  match(true, 2 * kFrames);
  EXPECT_FALSE(is_half());
  EXPECT_EQ(0, detail());
  gst_util_set_object_arg(G_OBJECT(harness.element()), "resolution", "half");
  match(false, 1);
  EXPECT_TRUE(is_half());
  EXPECT_EQ(log.lines_with("matched at half resolution"), 1) << "no choice";
}

}  // namespace
}  // namespace mtstereo::test::auto_resolution_test
