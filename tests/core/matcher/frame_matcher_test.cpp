// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/frame_matcher.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "support/compare.hpp"
#include "support/random.hpp"
#include "support/watching.hpp"

namespace mtstereo {
namespace {

using test::same_image;

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
      test::maps_after_steps(observed, pair().left, pair().right);
      plain.compute(pair().left.view(), pair().right.view());
      EXPECT_TRUE(same_image(test::copy_of(plain.disparity()), observed.disparity())) << preset;
      EXPECT_TRUE(same_image(test::copy_of(plain.confidence()), observed.confidence())) << preset;
    }
  }
}

TEST(FrameMatcher, ReturnsTheMapOfTheLastStep) {
  for (const char* const resolution : {"full", "half", "half-refined"}) {
    FrameMatcher matcher{Settings(test::parameters({{"resolution", resolution}}))};
    const test::StepMaps maps = test::maps_after_steps(matcher, pair().left, pair().right);
    EXPECT_TRUE(same_image(maps.back().second, matcher.disparity())) << resolution;
    EXPECT_EQ(150, matcher.confidence().width);
    EXPECT_EQ(70, matcher.confidence().height);
  }
}

TEST(FrameMatcher, HasNoResultBeforeTheFirstPairNorAfterAFailure) {
  FrameMatcher matcher{Settings(Parameters())};
  EXPECT_EQ(0, matcher.disparity().width);
  EXPECT_EQ(0, matcher.confidence().width);
  EXPECT_EQ(0, matcher.density());
  matcher.compute(pair().left.view(), pair().right.view());
  const test::DisparityPlane expected = test::copy_of(matcher.disparity());
  EXPECT_THROW(matcher.compute(pair().left.view(), pair().right.view(),
                               [](const Step&, const FrameMemory&) {
                                 throw std::runtime_error("the observer failed");
                               }),
               std::runtime_error);
  EXPECT_EQ(0, matcher.disparity().width);
  EXPECT_EQ(0, matcher.confidence().width);
  matcher.compute(pair().left.view(), pair().right.view());
  EXPECT_TRUE(same_image(expected, matcher.disparity())) << "not usable after a failure";
}

TEST(FrameMatcher, DensityIsTheFractionOfPixelsWithADisparity) {
  FrameMatcher matcher{Settings(Parameters())};
  matcher.compute(pair().left.view(), pair().right.view());
  const test::DisparityPlane map = test::copy_of(matcher.disparity());
  EXPECT_GT(test::known(map), 0);
  EXPECT_DOUBLE_EQ(test::known(map) / (150.0 * 70), matcher.density());
}

}  // namespace
}  // namespace mtstereo
