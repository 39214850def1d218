// SPDX-License-Identifier: LGPL-2.1-or-later
// The element states the difference of the frame numbers in its maps.
#include "support/numbered_views.hpp"

#include <gtest/gtest.h>

namespace mtstereo::test::numbered_views_test {
namespace {

class NumberedViews : public testing::TestWithParam<const char*> {
 protected:
  /// The map of the left frame `number` and the right frame `number + difference`.
  std::optional<int> difference_of(StereoHarness& harness, std::int64_t number, int difference) {
    harness.push(Side::kLeft, numbered_frame(Side::kLeft, number, next_));
    harness.push(Side::kRight, numbered_frame(Side::kRight, number + difference, next_));
    next_ += kFrame;
    const BufferPointer map = harness.pull();
    if (!map) ADD_FAILURE() << "no map: " << harness.error(1).text;
    return map ? frame_difference(map.get()) : std::nullopt;
  }
  void negotiate(StereoHarness& harness) {
    harness.caps(raw_caps("GRAY8", kNumberedWidth, kNumberedHeight));
  }

 private:
  GstClockTime next_ = 0;
};

TEST_P(NumberedViews, StateEveryDifference) {
  StereoHarness harness(GetParam());
  negotiate(harness);
  for (const std::int64_t number : {0, 1, 1000, -77, 123'456}) {
    for (int difference = -kMaxDifference; difference <= kMaxDifference; ++difference) {
      EXPECT_EQ(difference_of(harness, number, difference), difference) << "frame " << number;
    }
  }
}

TEST_P(NumberedViews, DoNotStateALargeDifference) {
  StereoHarness harness(GetParam());
  negotiate(harness);
  for (const int difference : {-1000, -60, -20, 12, 20, 60, 1000}) {
    EXPECT_EQ(difference_of(harness, 3, difference), std::nullopt) << difference;
  }
}

TEST_P(NumberedViews, AreNotCorrected) {
  StereoHarness harness(GetParam());
  negotiate(harness);
  for (int number = 0; number < 40; ++number) {
    EXPECT_EQ(difference_of(harness, number, number % 5 - 2), number % 5 - 2);
  }
  EXPECT_EQ(harness.message("mtstereo-alignment", 0.1), nullptr);
  EXPECT_TRUE(harness.warnings().empty());
}

INSTANTIATE_TEST_SUITE_P(Matching, NumberedViews,
                         testing::Values("max-disparity=64", kNumberedMatching),
                         [](const auto& info) { return info.index == 0 ? "Default" : "Fast"; });

TEST(Feed, CountsTheMapsOfSequences) {
  const auto left = numbered_sequence(20);
  auto right = left;
  right[7].number += 2;
  right[11].number += 500;
  const FeedResult result = feed(left, right);
  EXPECT_EQ(result.error, "");
  EXPECT_EQ(result.count.maps, 20);
  EXPECT_EQ(result.count.wrong, 1);
  EXPECT_EQ(result.count.unknown, 1);
  ASSERT_EQ(result.maps.size(), 20u);
  EXPECT_EQ(result.maps[7].difference, 2);
  EXPECT_EQ(result.maps[7].pts, 7 * kFrame);
  EXPECT_EQ(result.stats.pairs, 20u);
}

TEST(Feed, SurvivesVideoCompression) {
  for (const char* codec : {"x264enc", "avdec_h264", "h264parse"}) {
    GstElement* element = gst_element_factory_make(codec, nullptr);
    if (element == nullptr) GTEST_SKIP() << "there is no " << codec;
    gst_object_unref(element);
  }
  FeedOptions options;
  options.upstream =
      "videoconvert ! x264enc quantizer=28 pass=quant key-int-max=15 ! h264parse ! "
      "avdec_h264 ! queue";
  auto right = numbered_sequence(40);
  for (int i = 0; i < 40; ++i) right[static_cast<std::size_t>(i)].number += i % 13 - 6;
  const FeedResult result = feed(numbered_sequence(40), right, options);
  EXPECT_EQ(result.error, "");
  ASSERT_EQ(result.maps.size(), 40u);
  for (int i = 0; i < 40; ++i) {
    EXPECT_EQ(result.maps[static_cast<std::size_t>(i)].difference, i % 13 - 6) << i;
  }
}

TEST(Feed, IsLive) {
  FeedOptions options;
  options.live = true;
  auto right = numbered_sequence(10);
  right.erase(right.begin() + 4);
  const gint64 start = g_get_monotonic_time();
  const FeedResult result = feed(numbered_sequence(10), right, options);
  EXPECT_GE(g_get_monotonic_time() - start, static_cast<gint64>(9 * kFrame / 1000));
  EXPECT_EQ(result.error, "");
  EXPECT_EQ(result.count.maps, 9);
  EXPECT_EQ(result.count.wrong, 0);
  EXPECT_EQ(result.count.unknown, 0);
  EXPECT_EQ(result.stats.dropped_left, 1u);
}

TEST(Feed, ReportsErrorsAndWarnings) {
  auto right = numbered_sequence(40);
  for (NumberedFrame& frame : right) frame.pts += 17 * GST_SECOND;
  EXPECT_FALSE(feed(numbered_sequence(40), right).warnings.empty());
  for (NumberedFrame& frame : right) frame.pts = GST_CLOCK_TIME_NONE;
  EXPECT_NE(feed(numbered_sequence(40), right).error.find("sink_left"), std::string::npos);
}

}  // namespace
}  // namespace mtstereo::test::numbered_views_test
