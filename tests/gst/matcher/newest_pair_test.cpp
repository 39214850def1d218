// SPDX-License-Identifier: LGPL-2.1-or-later
// The property newest-pair: in a live pipeline whose matching is slower than its cameras, and whose
// sink does not synchronize, the age of the maps is bounded. Without it the age grows with the
// queues upstream.
#include <gtest/gtest.h>

#include <algorithm>
#include <mutex>

#include "support/defective_streams.hpp"
#include "support/pipeline.hpp"

namespace mtstereo::test::newest_pair_test {
namespace {

/// Time from the time stamp of a map to its arrival at the output [ms].
std::vector<double> ages_of(const FeedResult& result) {
  std::vector<double> ages;
  for (const NumberedMap& map : result.maps) {
    const auto age = static_cast<Nanoseconds>(map.arrival) - static_cast<Nanoseconds>(map.pts);
    ages.push_back(static_cast<double>(age) * 1e-6);
  }
  return ages;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// A camera and how long matching takes.
struct Speed {
  int framerate;
  double frames_per_map;

  double frame_ms() const { return 1000.0 / framerate; }
  /// By which every map is delayed.
  double delay_ms() const { return frames_per_map * frame_ms(); }
};

/// Time from one map to the next.
double matching_ms(const FeedResult& result, const Speed& speed) {
  return speed.delay_ms() + result.stats.mean_ms;
}

FeedResult play_live(const Speed& speed, const Defects& left, const Defects& right, int frames,
                     unsigned seed) {
  const GstClockTime interval = GST_SECOND / static_cast<GstClockTime>(speed.framerate);
  FeedOptions options;
  options.properties = std::string(kNumberedMatching) + " newest-pair=true";
  options.upstream = "queue";
  options.tail = "fakesink sync=false qos=false";
  options.live = true;
  options.duration = interval;
  options.delay = static_cast<GstClockTime>(speed.delay_ms() * 1e6);
  const std::string framerate = std::to_string(speed.framerate) + "/1";
  options.framerate = framerate.c_str();
  auto begin_at_once = [](std::vector<NumberedFrame> sequence) {
    for (NumberedFrame& frame : sequence) frame.pts -= GST_SECOND - 100 * GST_MSECOND;
    return sequence;
  };
  return feed(begin_at_once(defective_sequence(frames, left, seed, interval)),
              begin_at_once(defective_sequence(frames, right, seed + 100, interval)), options);
}

class NewestPair : public testing::TestWithParam<Speed> {};

// Feature: newest pair first if matching is too slow
TEST_P(NewestPair, BoundsTheAgeOfTheMaps) {
  const Speed speed = GetParam();
  const int frames = speed.framerate;
  const FeedResult result = play_live(speed, {}, {}, frames, 1);
  EXPECT_EQ(result.error, "");
  EXPECT_EQ(result.count.wrong + result.count.unknown, 0) << summary(result);
  ASSERT_GE(result.count.maps, 6) << summary(result);
  EXPECT_GT(result.stats.skipped, 0u) << summary(result);
  const std::vector<double> ages = ages_of(result);
  // 1.5 matching times and a frame, and a margin for a busy computer.
  EXPECT_LE(median(ages), 2.5 * matching_ms(result, speed) + speed.frame_ms()) << summary(result);
  const auto middle = ages.begin() + static_cast<std::ptrdiff_t>(ages.size() / 2);
  EXPECT_LE(median({middle, ages.end()}),
            median({ages.begin(), middle}) + matching_ms(result, speed))
      << "the age grows";
}

TEST_P(NewestPair, KeepsPairsRightDespiteLossAndSkew) {
  const Speed speed = GetParam();
  const auto skew = static_cast<Nanoseconds>(speed.frame_ms() * 1e6 / 4);
  const FeedResult result =
      play_live(speed, {.loss = 0.1}, {.skew = skew, .loss = 0.1}, speed.framerate, 7);
  EXPECT_EQ(result.error, "");
  ASSERT_GE(result.count.maps, 3) << summary(result);
  EXPECT_EQ(result.count.wrong + result.count.unknown, 0) << summary(result);
  EXPECT_LE(median(ages_of(result)), 2.5 * matching_ms(result, speed) + 3 * speed.frame_ms())
      << summary(result);
}

INSTANTIATE_TEST_SUITE_P(Speeds, NewestPair, testing::Values(Speed{30, 2}, Speed{100, 5}),
                         [](const auto& info) {
                           return std::to_string(info.param.framerate) + "fps";
                         });

TEST(NewestPairOfFiles, SkipsNothing) {
  FeedOptions options;
  options.properties = std::string(kNumberedMatching) + " newest-pair=true";
  options.upstream = "queue";
  options.delay = 5 * GST_MSECOND;
  const FeedResult result = feed(numbered_sequence(60), numbered_sequence(60), options);
  EXPECT_EQ(result.error, "");
  EXPECT_EQ(result.count.maps, 60);
  EXPECT_EQ(result.count.wrong + result.count.unknown, 0);
  EXPECT_EQ(result.stats.skipped + result.stats.dropped_left + result.stats.dropped_right, 0u);
}

/// Ages of maps that are measured at the output of an mtstereo named m.
class AgeProbe {
 public:
  explicit AgeProbe(const Pipeline& pipeline) : element_(pipeline.named("m")) {
    GstPad* output = gst_element_get_static_pad(element_, "src");
    gst_pad_add_probe(output, GST_PAD_PROBE_TYPE_BUFFER, on_map, this, nullptr);
    gst_object_unref(output);
  }
  std::vector<double> ages() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return ages_;
  }

 private:
  static GstPadProbeReturn on_map(GstPad*, GstPadProbeInfo* info, gpointer probe) {
    auto& self = *static_cast<AgeProbe*>(probe);
    const GstClockTime now = gst_element_get_current_running_time(self.element_);
    const GstClockTime pts = GST_BUFFER_PTS(GST_PAD_PROBE_INFO_BUFFER(info));
    const std::lock_guard<std::mutex> lock(self.mutex_);
    self.ages_.push_back(static_cast<double>(now) * 1e-6 - static_cast<double>(pts) * 1e-6);
    return GST_PAD_PROBE_OK;
  }

  GstElement* element_;
  std::mutex mutex_;
  std::vector<double> ages_;
};

// Feature: newest pair first if matching is too slow
TEST(NewestPairOfCameras, BoundsTheAgeWhileMatchingItselfIsSlow) {
  const auto launch = [](int framerate, int frames, bool live) {
    return "videotestsrc pattern=snow num-buffers=1 ! "
           "video/x-raw,format=GRAY8,width=480,height=360 ! imagefreeze is-live=" +
           std::string(live ? "true" : "false") + " num-buffers=" + std::to_string(frames) +
           " ! video/x-raw,framerate=" + std::to_string(framerate) +
           "/1 ! tee name=t mtstereo name=m max-disparity=64 threads=1 newest-pair=true ! "
           "queue ! fakesink sync=false qos=false t. ! queue ! m.sink_left "
           "t. ! queue ! videobox left=4 right=-4 ! m.sink_right";
  };
  double matching_ms = 0;
  {
    Pipeline pipeline(launch(30, 10, false));
    EXPECT_EQ(pipeline.run(), "");
    matching_ms = stats_of(pipeline.named("m")).mean_ms;
  }
  const int framerate = std::clamp(static_cast<int>(3000 / matching_ms), 2, 300);
  // Enough maps for a busy computer.
  Pipeline pipeline(launch(framerate, std::min(2 * framerate, 200), true));
  AgeProbe probe(pipeline);
  EXPECT_EQ(pipeline.run(), "");
  const std::vector<double> ages = probe.ages();
  ASSERT_GE(ages.size(), 6u);
  EXPECT_GT(stats_of(pipeline.named("m")).skipped, 0u);
  EXPECT_LE(median(ages), 2.5 * matching_ms + 1000.0 / framerate);
}

}  // namespace
}  // namespace mtstereo::test::newest_pair_test
