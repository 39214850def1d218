// SPDX-License-Identifier: LGPL-2.1-or-later
// Pipelines in which matching takes longer than a frame: the maps that are computed arrive at the
// sink in time. With MTSTEREO_PUNCTUALITY=1 all ratios and pipelines are measured and printed,
// which takes three minutes and needs an idle computer.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include "support/pipeline.hpp"
#include "support/sanitizers.hpp"
#include "support/stereo_harness.hpp"

namespace mtstereo::test::punctuality_test {
namespace {

constexpr const char* kSink = "fakesink name=out sync=true qos=true max-lateness=5000000";
const std::string kDirect = kSink;
const std::string kQueue = std::string("queue ! ") + kSink;
const std::string kDisplay = std::string("queue ! mtcolor ! videoconvert ! queue ! ") + kSink;

/// The size of the video, as caps, and what is downstream of mtstereo. The length of a video grows
/// with the time of matching, so it is smaller with a sanitizer.
struct Video {
  const char* size = test::kSanitized ? "width=160,height=120" : "width=320,height=240";
  std::string tail = kDisplay;
};

/// A pipeline with the same noise image in every frame, shifted by 4 px in the right view.
std::string launch(const Video& video, bool live, int frames, double rate) {
  char framerate[32];
  std::snprintf(framerate, sizeof framerate, "%d/1000", static_cast<int>(rate * 1000));
  return "videotestsrc pattern=snow num-buffers=1 ! "
         "video/x-raw,format=GRAY8," +
         std::string(video.size) + " ! imagefreeze is-live=" + (live ? "true" : "false") +
         " num-buffers=" + std::to_string(frames) + " ! video/x-raw,framerate=" + framerate +
         " ! tee name=t mtstereo name=m max-disparity=64 threads=1 ! " + video.tail +
         " t. ! queue ! m.sink_left "
         "t. ! queue ! videobox left=4 right=-4 ! m.sink_right";
}

/// Time from one map to the next if there is no clock [s]. The least of some runs, since other
/// programs may delay one of them.
double matching_time(const char* size) {
  double least = std::numeric_limits<double>::infinity();
  for (int run = 0; run < 3; ++run) {
    Pipeline pipeline(launch({size, "fakesink sync=false"}, false, 12, 1));
    EXPECT_EQ(pipeline.run(), "");
    least = std::min(least, stats_of(pipeline.named("m")).mean_ms / 1000);
  }
  return least;
}

/// The counts of one run.
struct Shown {
  std::uint64_t computed = 0;
  std::uint64_t shown = 0;
  std::uint64_t skipped = 0;
  double share() const {
    return computed == 0 ? 0 : static_cast<double>(shown) / static_cast<double>(computed);
  }
};

/// The first maps may be late, until the matcher knows how long it takes. So that they do not
/// decide, also where matching is slow, a video has at least this many matching times.
constexpr int kLeastMaps = 40;

/// Plays `seconds` of video, or more, in which `ratio` frames last one matching time.
Shown play(const Video& video, bool live, double ratio, double seconds) {
  const double time = matching_time(video.size);
  const double rate = ratio / time;
  const double played = std::max(seconds, kLeastMaps * time);
  Pipeline pipeline(launch(video, live, static_cast<int>(rate * played), rate));
  EXPECT_EQ(pipeline.run(), "");
  const Stats stats = stats_of(pipeline.named("m"));
  GstStructure* structure = nullptr;
  g_object_get(pipeline.named("out"), "stats", &structure, nullptr);
  const StructurePointer owner(structure);
  Shown result;
  result.computed = stats.pairs;
  result.skipped = stats.skipped;
  gst_structure_get_uint64(structure, "rendered", &result.shown);
  return result;
}

// Feature: QoS
TEST(Punctuality, MostMapsAreShownLive) {
  for (const double ratio : {2.0, 5.0}) {
    const Shown result = play({}, true, ratio, 1.5);
    EXPECT_GT(result.computed, 10u) << ratio;
    EXPECT_GT(result.skipped, 10u) << ratio;
    EXPECT_GE(result.share(), 0.8) << ratio << ": " << result.shown << " of " << result.computed;
  }
}

TEST(Punctuality, MostMapsAreShownOfFiles) {
  const Shown result = play({}, false, 3, 1.5);
  EXPECT_GT(result.computed, 10u);
  EXPECT_GT(result.skipped, 10u);
  EXPECT_GE(result.share(), 0.8) << result.shown << " of " << result.computed;
}

// Feature: newest pair first if matching is too slow
TEST(Punctuality, ASinkWithoutSynchronizationGetsAllMaps) {
  for (const bool live : {false, true}) {
    const Shown result =
        play({.tail = "queue ! fakesink name=out sync=false qos=true"}, live, 3, 0.2);
    EXPECT_EQ(result.skipped, 0u) << live;
    EXPECT_EQ(result.shown, result.computed) << live;
  }
}

/// A row of the table: live or not, and what is downstream.
struct Row {
  const char* name;
  bool live;
  const std::string& tail;
};

class PunctualityTable : public testing::TestWithParam<Row> {};

TEST_P(PunctualityTable, NearlyAllMapsAreShown) {
  if (std::getenv("MTSTEREO_PUNCTUALITY") == nullptr) GTEST_SKIP() << "set MTSTEREO_PUNCTUALITY=1";
  const Row& row = GetParam();
  std::printf("%-18s%8s%10s%8s%8s\n", row.name, "ratio", "computed", "shown", "skipped");
  for (const double ratio : {1.1, 1.5, 2.0, 3.0, 5.0, 10.0}) {
    const Shown result = play({"width=640,height=480", row.tail}, row.live, ratio, 8);
    std::printf("%-18s%8.1f%10d%8d%8d%7.1f%%\n", "", ratio, static_cast<int>(result.computed),
                static_cast<int>(result.shown), static_cast<int>(result.skipped),
                100 * result.share());
    std::fflush(stdout);
    EXPECT_GE(result.share(), 0.95) << ratio;
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, PunctualityTable,
    testing::Values(Row{"live, no queue", true, kDirect}, Row{"live, queue", true, kQueue},
                    Row{"live, display", true, kDisplay}, Row{"files, no queue", false, kDirect},
                    Row{"files, queue", false, kQueue}, Row{"files, display", false, kDisplay}),
    [](const auto& row) { return "row" + std::to_string(row.index); });

}  // namespace
}  // namespace mtstereo::test::punctuality_test
