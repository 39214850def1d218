// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "frame_stages.hpp"

namespace mtstereo::bench {
namespace {

bool has(const std::vector<std::string>& names, const char* name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

constexpr std::pair<const char*, const char*> kVariants[] = {
    {"default", "semi-dense"}, {"default", "sparse"}, {"default", "dense"},
    {"fast", "semi-dense"},    {"fast", "sparse"},    {"fast", "dense"},
    {"paper", "semi-dense"},   {"paper", "sparse"}};

// The constructor compares with the matcher; run again in any order, each gives the same again.
TEST(FrameStages, GiveTheMatchersResultAndCanBeRunAgain) {
  const Pair pair = render_street(203, 97);  // no whole number of bands
  for (const auto& [preset, mode] : kVariants) {
    SCOPED_TRACE(std::string(preset) + ", " + mode);
    const Parameters parameters = parameters_of(preset, mode, 24, 1);
    FrameStages stages(parameters, pair);
    std::vector<std::string> names = FrameStages::names(parameters);
    std::reverse(names.begin(), names.end());
    for (const std::string& name : names) {
      SCOPED_TRACE(name);
      for (int i = 0; i < 2; ++i) {
        stages.prepare(name);
        stages.run(name);
        EXPECT_NO_THROW(stages.require_result(name));
      }
    }
  }
}

TEST(FrameStages, RunOnWhatAnotherStageLeftIsNoticed) {
  const Pair pair = render_street(203, 97);
  FrameStages stages(parameters_of("default", "semi-dense", 24, 1), pair);
  stages.prepare("node-extrapolation");
  stages.run("node-extrapolation");
  EXPECT_THROW(stages.require_result("confidence"), std::runtime_error);
}

TEST(FrameStages, AreThoseThatTheParametersTurnOn) {
  const auto semi_dense = FrameStages::names(parameters_of("default", "semi-dense", 24, 1));
  EXPECT_TRUE(has(semi_dense, "census-matching"));
  EXPECT_FALSE(has(semi_dense, "gap-filling"));
  EXPECT_FALSE(has(semi_dense, "node-outliers"));
  EXPECT_TRUE(has(FrameStages::names(parameters_of("default", "dense", 24, 1)), "gap-filling"));
  Parameters sparse = parameters_of("default", "sparse", 24, 1);
  EXPECT_FALSE(has(FrameStages::names(sparse), "node-ends")) << "chosen before the rating";
  ASSERT_TRUE(sparse.set(Parameter::kRimTrim, 1).ok());
  EXPECT_TRUE(has(FrameStages::names(sparse), "node-ends")) << "chosen behind the rims";
  const auto paper = FrameStages::names(parameters_of("paper", "semi-dense", 24, 1));
  EXPECT_FALSE(has(semi_dense, "node-drawing")) << "only outliers are looked for in that map";
  EXPECT_TRUE(has(paper, "node-drawing"));
  EXPECT_TRUE(has(paper, "node-outliers"));
  EXPECT_TRUE(has(paper, "gradient-matching"));
  EXPECT_FALSE(has(paper, "census-matching"));
}

TEST(FrameStages, OfThePresetFastSurroundThoseOfHalfTheFrame) {
  const std::vector<std::string> fast =
      FrameStages::names(parameters_of("fast", "semi-dense", 24, 1));
  const auto default_names = FrameStages::names(parameters_of("default", "semi-dense", 24, 1));
  EXPECT_EQ("halving", fast.front());
  const std::vector<std::string> last(fast.end() - 4, fast.end());
  EXPECT_EQ((std::vector<std::string>{"smoothing", "enlarging", "frame-census", "refinement"}),
            last);
  for (const char* name : {"halving", "smoothing", "enlarging", "frame-census", "refinement"}) {
    EXPECT_FALSE(has(default_names, name)) << name;
  }
}

TEST(FrameStages, RunOnWhatAnotherStageOfTheFrameLeftIsNoticed) {
  const Pair pair = render_street(203, 97);
  FrameStages stages(parameters_of("fast", "semi-dense", 24, 1), pair);
  stages.prepare("speckle-removal");
  stages.run("enlarging");
  EXPECT_THROW(stages.require_result("enlarging"), std::runtime_error);
  stages.run("refinement");
  EXPECT_THROW(stages.require_result("refinement"), std::runtime_error);
}

TEST(FrameStages, UnknownNameIsAnError) {
  const Pair pair = render_street(64, 48);
  FrameStages stages(parameters_of("default", "dense", 16, 1), pair);
  EXPECT_THROW(stages.run("magic"), std::runtime_error);
  EXPECT_THROW(stages.prepare(""), std::runtime_error);
}

TEST(FrameStages, FrameThatTheMatcherRefusesIsAnError) {
  const Pair pair = render_street(64, 48);
  EXPECT_THROW(FrameStages(parameters_of("default", "dense", 100, 1), pair), std::runtime_error);
}

}  // namespace
}  // namespace mtstereo::bench
