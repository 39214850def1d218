// SPDX-License-Identifier: LGPL-2.1-or-later
// The confidence maps of mtstereo on their way through a pipeline.
#include <gtest/gtest.h>

#include "pipeline.hpp"

namespace mtstereo::test {
namespace {

/// noise_launch() with these elements ahead of the sink.
std::string launch_with(const std::string& stereo, const std::string& behind) {
  std::string launch = noise_launch(3, "max-disparity=16 " + stereo);
  return launch.insert(launch.find("! appsink name=out"), "! " + behind + " ");
}

/// What mtstereo gives with nothing behind it.
std::vector<Sample> direct_samples() {
  Pipeline direct(noise_launch(3, "max-disparity=16"));
  EXPECT_EQ(direct.run(), "");
  return direct.samples();
}

class ConfidenceStays : public testing::TestWithParam<const char*> {};

TEST_P(ConfidenceStays, BehindAnElementThatKeepsThePixels) {
  Pipeline through(launch_with("", GetParam()));
  ASSERT_EQ(through.run(), "");
  const auto expected = direct_samples();
  const auto samples = through.samples();
  ASSERT_EQ(samples.size(), 3u);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    ASSERT_EQ(samples[i].confidence.size(), 160u * 120);
    EXPECT_EQ(samples[i].confidence, expected[i].confidence) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Elements, ConfidenceStays,
                         testing::Values("queue", "identity", "identity drop-allocation=true",
                                         "tee name=x ! queue",
                                         "tee name=x x. ! queue ! fakesink sync=false x. ! queue",
                                         "videoconvert ! video/x-raw,format=GRAY16_BE",
                                         "videorate ! queue", "capsfilter caps=video/x-raw"),
                         [](const auto& info) { return "Case" + std::to_string(info.index); });

class ConfidenceGoes : public testing::TestWithParam<const char*> {};

TEST_P(ConfidenceGoes, WhereAnElementMovesThePixels) {
  Pipeline through(launch_with("", GetParam()));
  ASSERT_EQ(through.run(), "");
  const auto samples = through.samples();
  ASSERT_EQ(samples.size(), 3u);
  for (const Sample& sample : samples) EXPECT_TRUE(sample.confidence.empty());
}

INSTANTIATE_TEST_SUITE_P(Elements, ConfidenceGoes,
                         testing::Values("videoscale ! video/x-raw,width=80,height=60",
                                         "videoscale ! video/x-raw,width=320,height=240",
                                         "videocrop left=8", "videobox left=8 right=-8",
                                         "videobox left=8", "mtcolor"),
                         [](const auto& info) { return "Case" + std::to_string(info.index); });

}  // namespace
}  // namespace mtstereo::test
