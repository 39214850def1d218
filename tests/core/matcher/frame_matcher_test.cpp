// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/frame_matcher.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "support/compare.hpp"
#include "support/random.hpp"
#include "support/watching.hpp"

namespace mtstereo::frame_matcher_test {
namespace {

const test::Pair& pair() {
  static const test::Pair pair = test::slanted_pair(150, 70, 30, 1);
  return pair;
}

constexpr const char* kPresetNames[] = {"default", "fast", "paper"};

TEST(FrameMatcher, ReportsEachStepOnceInTheOrderOfTheList) {
  for (const char* const preset : kPresetNames) {
    const Parameters parameters = test::parameters({{"preset", preset}});
    FrameMatcher matcher{Settings(parameters)};
    std::vector<std::string> seen;
    matcher.compute(pair().left.view(), pair().right.view(),
                    [&](const Step& step, const FrameMemory&) { seen.emplace_back(step.name); });
    EXPECT_EQ(test::names_of_steps(parameters), seen) << preset;
  }
}

TEST(FrameMatcher, GivesTheSameResultWithAndWithoutAnObserver) {
  for (const char* const preset : kPresetNames) {
    const Settings settings(test::parameters({{"preset", preset}}));
    FrameMatcher observed(settings), plain(settings);
    for (int frame = 0; frame < 2; ++frame) {
      const GrayView left = pair().left.view(), right = pair().right.view();
      const FrameResult expected = plain.compute(left, right);
      const FrameResult result =
          observed.compute(left, right, [](const Step&, const FrameMemory&) {});
      EXPECT_TRUE(same_image(test::copy_of(expected.disparity), result.disparity)) << preset;
      EXPECT_TRUE(same_image(test::copy_of(expected.confidence), result.confidence)) << preset;
    }
  }
}

TEST(FrameMatcher, ReturnsTheMapOfTheLastStep) {
  for (const char* const resolution : {"full", "half", "half-refined"}) {
    FrameMatcher matcher{Settings(test::parameters({{"resolution", resolution}}))};
    const test::StepMaps maps = test::maps_after_steps(matcher, pair().left, pair().right);
    const DisparityPlane& result = maps.back().second;
    EXPECT_TRUE(same_image(maps[maps.size() - 2].second, result.view())) << resolution;
    EXPECT_EQ(150, result.width);
    EXPECT_EQ(70, result.height);
  }
}

TEST(FrameMatcher, IsUsableAfterAFailure) {
  FrameMatcher matcher{Settings(Parameters())};
  const GrayView left = pair().left.view(), right = pair().right.view();
  const DisparityPlane expected = test::copy_of(matcher.compute(left, right).disparity);
  EXPECT_THROW(matcher.compute(left, right,
                               [](const Step&, const FrameMemory&) {
                                 throw std::runtime_error("the observer failed");
                               }),
               std::runtime_error);
  EXPECT_TRUE(same_image(expected, matcher.compute(left, right).disparity));
}

TEST(FrameMatcher, DensityIsTheFractionOfPixelsWithADisparity) {
  FrameMatcher matcher{Settings(Parameters())};
  const FrameResult result = matcher.compute(pair().left.view(), pair().right.view());
  const DisparityPlane map = test::copy_of(result.disparity);
  EXPECT_GT(test::known(map), 0);
  EXPECT_DOUBLE_EQ(test::known(map) / (150.0 * 70), result.statistics.density);
}

}  // namespace
}  // namespace mtstereo::frame_matcher_test
