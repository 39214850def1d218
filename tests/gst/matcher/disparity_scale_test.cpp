// SPDX-License-Identifier: LGPL-2.1-or-later
// The disparity scale follows the search range unless it is set.
#include <gtest/gtest.h>

#include "support/fixtures.hpp"

namespace mtstereo::test::disparity_scale_test {
namespace {

class DisparityScale : public StreamsTest {
 protected:
  DisparityScale() { pair = noise_pair(320, 40, 4, 4); }
  void set(const char* name, int value) { g_object_set(harness->element(), name, value, nullptr); }
  /// The property.
  int scale() { return std::stoi(get("disparity-scale")); }
  /// Matches a pair: caps, statistics and map must have this range and scale.
  void expect_map(int disparities, int scale) {
    Parameters parameters;
    EXPECT_TRUE(parameters.set(Parameter::kMaxDisparity, disparities).ok());
    expect_next(parameters, scale);
    EXPECT_EQ(scale_in_caps(), scale);
    EXPECT_EQ(scale_in_stats(), scale);
  }

 private:
  int scale_in_caps() {
    int value = 0;
    const CapsPointer caps = harness->output_caps();
    gst_structure_get_int(gst_caps_get_structure(caps.get(), 0), "disparity-scale", &value);
    return value;
  }
  int scale_in_stats() {
    GstStructure* stats = nullptr;
    g_object_get(harness->element(), "stats", &stats, nullptr);
    int value = 0;
    gst_structure_get_int(stats, "disparity-scale", &value);
    gst_structure_free(stats);
    return value;
  }
};

// Feature: documented scale that can be selected
TEST_F(DisparityScale, FollowsTheRange) {
  start("max-disparity=64");
  for (const auto& [disparities, expected] :
       {std::pair{255, 256}, std::pair{256, 128}, std::pair{300, 128}, std::pair{64, 256}}) {
    set("max-disparity", disparities);
    EXPECT_EQ(scale(), expected) << disparities;
    expect_map(disparities, expected);
  }
  EXPECT_TRUE(harness->warnings().empty());
}

TEST_F(DisparityScale, FitsTheLargestRange) {
  start("max-disparity=1984");
  EXPECT_EQ(scale(), 32);
  start("min-disparity=-100 max-disparity=200");
  EXPECT_EQ(scale(), 128);
  set("min-disparity", 0);
  EXPECT_EQ(scale(), 256);
}

TEST_F(DisparityScale, StaysIfItIsSet) {
  start("max-disparity=64 disparity-scale=256");
  set("max-disparity", 256);
  expect_map(64, 256);
  const auto warnings = harness->warnings();
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].text.find("disparity-scale = 256 does not fit in 16 bits"),
            std::string::npos)
      << warnings[0].text;
  start("disparity-scale=16");
  set("max-disparity", 300);
  expect_map(300, 16);
}

TEST_F(DisparityScale, ReturnsWithARangeThatIsRefused) {
  start("max-disparity=64");
  expect_map(64, 256);
  set("max-disparity", 600);  // wider than the frame
  EXPECT_EQ(scale(), 64);
  expect_map(64, 256);
  EXPECT_EQ(harness->warnings().size(), 1u);
  EXPECT_EQ(scale(), 256);
  set("max-disparity", 300);
  expect_map(300, 128);
}

}  // namespace
}  // namespace mtstereo::test::disparity_scale_test
