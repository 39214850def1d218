// SPDX-License-Identifier: LGPL-2.1-or-later
// Confidence maps of mtstereo in pipelines, and mtconfidence in pipelines.
#include <gtest/gtest.h>

#include "support/pipeline.hpp"

namespace mtstereo::test::confidence_pipeline_test {
namespace {

/// noise_launch() with these properties of mtstereo, and these elements upstream of the sink.
std::string launch_with(const std::string& stereo, const std::string& downstream) {
  std::string launch = noise_launch(3, "max-disparity=16 " + stereo);
  return launch.insert(launch.find("! appsink name=out"), "! " + downstream + " ");
}

/// The output of mtstereo without further elements.
std::vector<Sample> direct_samples() {
  Pipeline direct(noise_launch(3, "max-disparity=16"));
  EXPECT_EQ(direct.run(), "");
  return direct.samples();
}

class ConfidenceIsKept : public testing::TestWithParam<const char*> {};

TEST_P(ConfidenceIsKept, ByAnElementThatKeepsThePixels) {
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

INSTANTIATE_TEST_SUITE_P(Elements, ConfidenceIsKept,
                         testing::Values("queue", "identity", "identity drop-allocation=true",
                                         "tee name=x ! queue",
                                         "tee name=x x. ! queue ! fakesink sync=false x. ! queue",
                                         "videoconvert ! video/x-raw,format=GRAY16_BE",
                                         "videorate ! queue", "mtconfidence",
                                         "capsfilter caps=video/x-raw"),
                         [](const auto& info) { return "Case" + std::to_string(info.index); });

class ConfidenceIsRemoved : public testing::TestWithParam<const char*> {};

TEST_P(ConfidenceIsRemoved, ByAnElementThatMovesThePixels) {
  Pipeline through(launch_with("", GetParam()));
  ASSERT_EQ(through.run(), "");
  const auto samples = through.samples();
  ASSERT_EQ(samples.size(), 3u);
  for (const Sample& sample : samples) EXPECT_TRUE(sample.confidence.empty());
}

INSTANTIATE_TEST_SUITE_P(Elements, ConfidenceIsRemoved,
                         testing::Values("videoscale ! video/x-raw,width=80,height=60",
                                         "videoscale ! video/x-raw,width=320,height=240",
                                         "videocrop left=8", "videobox left=8 right=-8",
                                         "videobox left=8", "mtcolor"),
                         [](const auto& info) { return "Case" + std::to_string(info.index); });

TEST(MtConfidence, FiltersTheOutputOfMtstereo) {
  Pipeline pipeline(launch_with("", "queue ! mtconfidence min-confidence=240"));
  ASSERT_EQ(pipeline.run(), "");
  const auto before = direct_samples();
  const auto after = pipeline.samples();
  ASSERT_EQ(after.size(), 3u);
  for (std::size_t frame = 0; frame < after.size(); ++frame) {
    std::size_t dropped = 0;
    for (std::size_t i = 0; i < before[frame].confidence.size(); ++i) {
      const bool keep = before[frame].confidence[i] >= 240;
      dropped += !keep && before[frame].confidence[i] > 0;
      const auto value = [&](const Sample& s) { return s.bytes[2 * i] | s.bytes[2 * i + 1] << 8; };
      ASSERT_EQ(value(after[frame]), keep ? value(before[frame]) : 0) << i;
      ASSERT_EQ(after[frame].confidence[i], keep ? before[frame].confidence[i] : 0) << i;
    }
    EXPECT_GT(dropped, 0u);
  }
}

// Feature: confidence for each pixel
TEST(MtConfidence, OutputsTheConfidenceOfMtstereo) {
  Pipeline pipeline(launch_with("", "mtconfidence output=confidence"));
  ASSERT_EQ(pipeline.run(), "");
  const auto before = direct_samples();
  const auto after = pipeline.samples();
  ASSERT_EQ(after.size(), 3u);
  for (std::size_t i = 0; i < after.size(); ++i) EXPECT_EQ(after[i].bytes, before[i].confidence);
}

TEST(MtConfidence, ReportsADisabledConfidenceMap) {
  Pipeline pipeline(launch_with("confidence-map=false", "mtconfidence"));
  const std::string error = pipeline.run();
  EXPECT_NE(error.find("confidence-map=true"), std::string::npos) << error;
}

TEST(MtConfidence, ReportsAScalerUpstream) {
  Pipeline pipeline(launch_with("", "videoscale ! video/x-raw,width=80,height=60 ! mtconfidence"));
  const std::string error = pipeline.run();
  EXPECT_NE(error.find("videoscale"), std::string::npos) << error;
}

TEST(MtConfidence, DoesNotAffectOtherBranchesOfATee) {
  Pipeline pipeline(launch_with(
      "",
      "tee name=s s. ! queue ! mtconfidence min-confidence=255 ! fakesink sync=false s. ! "
      "queue"));
  ASSERT_EQ(pipeline.run(), "");
  const auto expected = direct_samples();
  const auto samples = pipeline.samples();
  ASSERT_EQ(samples.size(), 3u);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    EXPECT_EQ(samples[i].bytes, expected[i].bytes);
    EXPECT_EQ(samples[i].confidence, expected[i].confidence);
  }
}

}  // namespace
}  // namespace mtstereo::test::confidence_pipeline_test
