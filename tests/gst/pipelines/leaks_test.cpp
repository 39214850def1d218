// SPDX-License-Identifier: LGPL-2.1-or-later
// GStreamer objects that are alive at the end of a program, as reported by the tracer "leaks".
// Each scenario runs in its own process of this program.
#include <gst/gst.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>

#include "support/pipeline.hpp"
#include "support/stereo_harness.hpp"
#include "support/test_environment.hpp"

namespace mtstereo::test::leaks_test {
namespace {

constexpr const char* kScenarioVariable = "MTSTEREO_LEAKS_SCENARIO";

void leave_a_buffer() { gst_buffer_new(); }

/// Checks that an element was freed. The tracer does not track elements derived from GstAggregator.
class Watch {
 public:
  explicit Watch(GstElement* element) : element_(element) {
    g_object_add_weak_pointer(G_OBJECT(element), &element_);
  }
  ~Watch() { EXPECT_EQ(element_, nullptr) << "the element is still alive"; }
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

 private:
  gpointer element_;
};

void play_to_the_end() {
  std::optional<Watch> watch;
  Pipeline pipeline(noise_launch(5, "max-disparity=16"));
  watch.emplace(pipeline.named("m"));
  EXPECT_EQ(pipeline.run(), "");
  EXPECT_EQ(pipeline.samples().size(), 5u);
}

void stop_in_the_middle() {
  Pipeline pipeline(noise_launch(1000, "max-disparity=16"));
  pipeline.set_state(GST_STATE_PAUSED);
  EXPECT_TRUE(pipeline.wait_until_settled());
}

void drop_frames_and_send_gaps() {
  const Pair pair = noise_pair(64, 48, 4, 1);
  std::optional<Watch> watch;
  StereoHarness harness;
  watch.emplace(harness.element());
  harness.caps(raw_caps("GRAY8", 64, 48));
  harness.push(Side::kLeft, frame_buffer(pair.left, 0, kFrame));
  // Left frames up to the second right one have no partners; so late a first frame is checked.
  harness.push(Side::kRight, frame_buffer(pair.right, 5 * kFrame, kFrame));
  harness.push(Side::kLeft, frame_buffer(pair.left, kFrame / 2, kFrame));
  harness.push(Side::kRight, frame_buffer(pair.right, 6 * kFrame, kFrame));
  EXPECT_TRUE(harness.wait_for_stats(0, 2, 0));
  harness.event(Side::kLeft, gst_event_new_gap(kFrame, kFrame));
  harness.push(Side::kLeft, frame_buffer(pair.left, 5 * kFrame, kFrame));
  EXPECT_TRUE(harness.pull());
  harness.event(Side::kRight, gst_event_new_segment_done(GST_FORMAT_TIME, 0));
  harness.end(Side::kRight);
  harness.end(Side::kLeft);
  EXPECT_TRUE(harness.pull_event(GST_EVENT_EOS));
}

void give_errors() {
  {
    StereoHarness harness;
    harness.caps(raw_caps("GRAY8", 64, 48) + ",interlace-mode=interleaved",
                 raw_caps("GRAY8", 64, 48));
    EXPECT_NE(harness.error().text, "");
  }
  StereoHarness harness;
  harness.caps(raw_caps("GRAY8", 64, 48), raw_caps("GRAY8", 32, 24));
  harness.push(Side::kLeft, frame_buffer(noise_pair(64, 48, 4, 1).left, 0, kFrame));
  harness.push(Side::kRight, frame_buffer(noise_pair(32, 24, 4, 1).right, 0, kFrame));
  EXPECT_NE(harness.error().text, "");
}

void make_colors() {
  Pipeline pipeline(
      "videotestsrc num-buffers=3 ! video/x-raw,format=GRAY16_LE,width=64,height=48 ! mtcolor ! "
      "fakesink");
  EXPECT_EQ(pipeline.run(), "");
}

/// Keeps maps, also with changed confidence, until after their elements are freed.
void make_confidence() {
  std::vector<BufferPointer> held;
  for (const char* downstream : {"identity", "mtconfidence min-confidence=100",
                                 "mtconfidence output=confidence", "tee ! queue ! mtconfidence"}) {
    std::string launch = noise_launch(4, "max-disparity=16");
    launch.insert(launch.find("! appsink"), std::string("! ") + downstream + " ");
    Pipeline pipeline(launch);
    EXPECT_EQ(pipeline.run(), "");
    GstSample* sample = nullptr;
    g_signal_emit_by_name(pipeline.named("out"), "pull-sample", &sample);
    held.emplace_back(gst_buffer_ref(gst_sample_get_buffer(sample)));
    gst_sample_unref(sample);
    EXPECT_EQ(pipeline.samples().size(), 3u);
  }
  EXPECT_EQ(confidence_of(held[0].get()).size(), 160u * 120);
}

void miss_the_confidence() {
  std::string launch = noise_launch(4, "max-disparity=16 confidence-map=false");
  launch.insert(launch.find("! appsink"), "! mtconfidence ");
  Pipeline pipeline(launch);
  EXPECT_NE(pipeline.run(), "");
}

void make_depths_and_clouds() {
  const std::string folder = g_get_tmp_dir();
  const std::string file = folder + "/mtstereo-leaks-" + std::to_string(getpid()) + ".ply";
  std::string launch = noise_launch(4, "max-disparity=16");
  launch.insert(launch.find("! appsink"),
                "! tee name=d d. ! queue ! mtcloud name=c focal-length=100 baseline=0.1 location=" +
                    file + " d. ! queue ! mtdepth focal-length=100 baseline=0.1 ");
  launch += " t. ! queue ! c.sink_left";
  for (const bool stop_early : {true, false}) {
    Pipeline pipeline(launch);
    if (stop_early) {
      pipeline.set_state(GST_STATE_PAUSED);
      EXPECT_TRUE(pipeline.wait_until_settled());
    } else {
      EXPECT_EQ(pipeline.run(), "");
      EXPECT_EQ(pipeline.samples().size(), 4u);
    }
  }
  EXPECT_EQ(unlink(file.c_str()), 0);
}

struct Scenario {
  const char* name;
  void (*run)();
};
constexpr std::array kScenarios = {Scenario{"LeaveABuffer", leave_a_buffer},
                                   Scenario{"PlayToTheEnd", play_to_the_end},
                                   Scenario{"StopInTheMiddle", stop_in_the_middle},
                                   Scenario{"DropFramesAndSendGaps", drop_frames_and_send_gaps},
                                   Scenario{"GiveErrors", give_errors},
                                   Scenario{"MakeColors", make_colors},
                                   Scenario{"MakeConfidence", make_confidence},
                                   Scenario{"MissTheConfidence", miss_the_confidence},
                                   Scenario{"MakeDepthsAndClouds", make_depths_and_clouds}};

struct Outcome {
  int status = 0;
  std::string output;
  /// True if the tracer reports an object. It also prints the format of its lines, with "%s" as
  /// name.
  bool leaks() const {
    return output.find("object-alive, type-name=(string)Gst") != std::string::npos;
  }
};

Outcome run_alone(const std::string& scenario) {
  const std::string command = std::string(kScenarioVariable) + "=" + scenario +
                              " GST_TRACERS=leaks GST_DEBUG=GST_TRACER:7 GST_DEBUG_NO_COLOR=1"
                              " timeout 60 /proc/" +
                              std::to_string(getpid()) + "/exe 2>&1";
  Outcome outcome;
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) {
    ADD_FAILURE() << command;
    return outcome;
  }
  std::array<char, 4096> line;
  while (std::fgets(line.data(), line.size(), pipe) != nullptr) outcome.output += line.data();
  outcome.status = pclose(pipe);
  return outcome;
}

int run_scenario(const char* name) {
  const TestEnvironment environment;
  testing::InitGoogleTest();
  gst_init(nullptr, nullptr);
  bool found = false;
  for (const Scenario& scenario : kScenarios) {
    if (std::strcmp(scenario.name, name) != 0) continue;
    scenario.run();
    found = true;
  }
  gst_deinit();
  return found && !testing::Test::HasFailure() ? 0 : 1;
}

TEST(Leaks, AreDetectedIfABufferIsNotFreed) {
  const Outcome outcome = run_alone("LeaveABuffer");
  EXPECT_EQ(outcome.status, 0) << outcome.output;
  EXPECT_TRUE(outcome.leaks()) << outcome.output;
}

class NoLeaks : public testing::TestWithParam<const char*> {};

// Feature: leaks, sanitizers, fuzzing
TEST_P(NoLeaks, InScenario) {
  const Outcome outcome = run_alone(GetParam());
  EXPECT_EQ(outcome.status, 0) << outcome.output;
  EXPECT_FALSE(outcome.leaks()) << outcome.output;
}

INSTANTIATE_TEST_SUITE_P(Scenarios, NoLeaks,
                         testing::Values("PlayToTheEnd", "StopInTheMiddle", "DropFramesAndSendGaps",
                                         "GiveErrors", "MakeColors", "MakeConfidence",
                                         "MissTheConfidence", "MakeDepthsAndClouds"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace mtstereo::test::leaks_test

int main(int argc, char** argv) {
  if (const char* scenario = std::getenv(mtstereo::test::leaks_test::kScenarioVariable)) {
    return mtstereo::test::leaks_test::run_scenario(scenario);
  }
  return mtstereo::test::run_tests(argc, argv);
}
