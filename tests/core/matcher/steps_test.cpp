// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/steps.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "support/watching.hpp"

namespace mtstereo::steps_test {
namespace {

using Names = std::vector<std::string>;

TEST(Steps, HaveUniqueNames) {
  for (const StepList& matcher : {kPathSteps, kNodeSteps}) {
    std::set<std::string_view> names;
    for (const StepList& list : {kViewSteps, matcher, kResultSteps, kSizeSteps}) {
      for (const Step& step : list) EXPECT_TRUE(names.insert(step.name).second) << step.name;
    }
  }
}

/// Expects all of these steps to run in this order; others may run between them.
void expect_order(const Parameters& parameters, const Names& expected) {
  const Names names = test::names_of_steps(parameters);
  auto at = names.begin();
  for (const std::string& name : expected) {
    const auto found = std::find(at, names.end(), name);
    if (found == names.end()) {
      ADD_FAILURE() << name << " does not run or runs too early";
    } else {
      at = found + 1;
    }
  }
}

void expect_none_of(const Parameters& parameters, const Names& absent) {
  for (const std::string& name : test::names_of_steps(parameters)) {
    EXPECT_EQ(0, std::count(absent.begin(), absent.end(), name)) << name << " runs";
  }
}

TEST(Steps, RunInOrderWithTheDefaults) {
  expect_order({}, {"block-borders",  "contrast",    "noise-filter",    "reduced-matching",
                    "search-windows", "census",      "path-matching",   "guide-support",
                    "guide-rating",   "thin-search", "speckle-removal", "confidence",
                    "smoothing",      "fine-detail", "completion",      "edge-check",
                    "reliability",    "rejection",   "gap-closing",     "thin-drawing"});
  expect_none_of({}, {"edge-alignment", "halving", "preprocessing", "max-trees", "node-matching",
                      "enlarging", "input-census", "refinement"});
}

TEST(Steps, CloseGapsOfTheCompleteMapAfterTheRejection) {
  const Parameters dense = test::parameters({{"mode", "dense"}, {"max-gap", "1"}});
  expect_order(dense, {"completion", "rejection", "gap-closing", "thin-drawing"});
  for (const char* const mode : {"semi-dense", "dense"}) {
    expect_none_of(test::parameters({{"mode", mode}, {"max-gap", "0"}}), {"gap-closing"});
  }
  expect_none_of(test::parameters({{"mode", "full"}, {"max-gap", "9"}}), {"gap-closing"});
}

TEST(Steps, RejectUnlikelyDisparitiesOfTheCompleteMapInModeDense) {
  const Parameters dense = test::parameters({{"mode", "dense"}});
  expect_order(dense, {"path-matching", "guide-support", "guide-rating", "thin-search",
                       "speckle-removal", "completion", "edge-alignment", "reliability",
                       "flat-planes", "plane-check", "rejection", "thin-drawing"});
  expect_none_of(dense,
                 {"fine-detail", "left-strip", "plane-completion", "node-matching", "gap-closing"});
  expect_none_of(test::parameters({{"mode", "dense"}, {"min-confidence", "0"}}), {"rejection"});
}

TEST(Steps, MatchAlongPathsInsteadOfNodesInModeFull) {
  const Parameters full = test::parameters({{"mode", "full"}});
  expect_order(full,
               {"noise-filter", "reduced-matching", "search-windows", "census", "path-matching",
                "guide-support", "guide-rating", "speckle-removal", "confidence", "smoothing",
                "completion", "edge-alignment", "reliability", "left-strip"});
  expect_none_of(full, {"fine-detail", "edge-check", "rejection", "thin-drawing", "preprocessing",
                        "max-trees", "node-matching", "node-extrapolation"});
}

TEST(Steps, EnlargeTheCompleteMapOfHalvedViews) {
  const Parameters fast =
      test::parameters({{"mode", "full"}, {"preset", "fast"}, {"min-disparity", "3"}});
  expect_order(fast, {"halving", "path-matching", "guide-rating", "completion", "edge-alignment",
                      "reliability", "flat-planes", "plane-completion", "input-census",
                      "refinement", "enlarging", "enlarged-edges", "map-shift"});
  expect_none_of(fast, {"plane-check", "plane-edges"});
  expect_none_of(test::parameters({{"mode", "full"}}), {"enlarged-edges"});
}

TEST(Steps, AreThoseOfSemiDenseInModeFullOfThePaper) {
  EXPECT_EQ(test::names_of_steps(test::parameters({{"mode", "full"}, {"preset", "paper"}})),
            test::names_of_steps(test::parameters({{"mode", "semi-dense"}, {"preset", "paper"}})));
}

TEST(Steps, MatchHalvedViewsInPresetFast) {
  const Parameters fast = test::parameters({{"preset", "fast"}});
  expect_order(fast, {"halving", "reduced-matching", "census", "path-matching", "confidence",
                      "smoothing", "fine-detail", "reliability", "rejection", "thin-drawing",
                      "input-census", "refinement", "enlarging"});
  expect_none_of(fast, {"max-trees", "noise-filter", "enlarged-edges"});
}

TEST(Steps, AreThoseOfThePaperInPresetPaper) {
  const Parameters paper = test::parameters({{"preset", "paper"}});
  expect_order(paper, {"preprocessing", "max-trees", "cost-volume", "node-matching", "node-drawing",
                       "node-outliers", "node-extrapolation", "gradient-matching", "pixel-outliers",
                       "confidence"});
  expect_none_of(paper, {"halving", "block-borders", "contrast", "noise-filter", "census",
                         "speckle-removal", "smoothing", "reduced-matching", "completion",
                         "rejection", "enlarging", "input-census", "refinement"});
}

TEST(Steps, AreEnabledBySettings) {
  const auto runs = [](const char* step, const char* parameter, const char* value,
                       const char* cost = "census") {
    const Names names =
        test::names_of_steps(test::parameters({{"cost", cost}, {parameter, value}}));
    return std::count(names.begin(), names.end(), step) > 0;
  };
  EXPECT_FALSE(runs("speckle-removal", "speckle-size", "0"));
  EXPECT_FALSE(runs("speckle-removal", "speckle-size", "1"));
  EXPECT_TRUE(runs("speckle-removal", "speckle-size", "2"));
  EXPECT_FALSE(runs("noise-filter", "noise-filter", "false"));
  EXPECT_FALSE(runs("time-filter", "temporal", "hold"));
  EXPECT_TRUE(runs("time-filter", "temporal", "filter"));
  EXPECT_TRUE(runs("gap-closing", "max-gap", "1"));
  EXPECT_FALSE(runs("gap-closing", "max-gap", "0"));
  EXPECT_FALSE(runs("thin-search", "thin-objects", "false"));
  EXPECT_TRUE(runs("smoothing", "smoothing-radius", "1"));
  EXPECT_TRUE(runs("node-outliers", "outlier-radius", "1", "gradient"));
  EXPECT_FALSE(runs("pixel-outliers", "outlier-radius", "1", "gradient"));
  EXPECT_TRUE(runs("enlarging", "resolution", "half"));
  EXPECT_FALSE(runs("refinement", "resolution", "half"));
  EXPECT_FALSE(runs("max-trees", "max-gap", "1"));
  EXPECT_TRUE(runs("max-trees", "max-gap", "1", "gradient"));
  EXPECT_FALSE(runs("rejection", "max-gap", "1", "gradient"));
}

TEST(Steps, CorrectTheViewsFirstButForTheirNoise) {
  Settings settings{Parameters()};
  ASSERT_EQ("time-filter", kViewSteps[0].name);
  const Step& rows = kViewSteps[1];
  ASSERT_EQ("row-alignment", rows.name);
  ASSERT_EQ("view-shift", kViewSteps[2].name);
  const Step& sharpness = kViewSteps[3];
  ASSERT_EQ("sharpness", sharpness.name);
  EXPECT_FALSE(rows.runs(settings) || sharpness.runs(settings));
  settings.correction.rows.square = -0.1;
  EXPECT_TRUE(rows.runs(settings) && !sharpness.runs(settings));
  settings.correction = {{}, 0, 0.5F};
  EXPECT_TRUE(!rows.runs(settings) && sharpness.runs(settings));
  settings.correction = {{}, 0.5F, 0};
  EXPECT_TRUE(!rows.runs(settings) && sharpness.runs(settings));
}

}  // namespace
}  // namespace mtstereo::steps_test
