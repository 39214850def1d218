// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mtstereo/matcher.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <memory>
#include <utility>

#include "mtstereo/mtstereo.hpp"
#include "support/compare.hpp"
#include "support/matching.hpp"
#include "support/parameter_samples.hpp"
#include "support/random.hpp"

namespace mtstereo::matcher_test {
namespace {

using test::Pair;

/// The result of a new matcher for a pair.
DisparityPlane matched_once(const Parameters& parameters, const Pair& pair) {
  Result<Matcher> matcher = Matcher::create(parameters);
  EXPECT_TRUE(matcher.ok());
  return test::compute(*matcher, pair.left, pair.right);
}

TEST(Matcher, HasTheParametersItIsCreatedWith) {
  const Matcher matcher = test::matcher({{"max-disparity", "77"}, {"mode", "sparse"}});
  EXPECT_EQ(77, matcher.parameters().integer(Parameter::kMaxDisparity));
  EXPECT_EQ(Mode::kSparse, matcher.parameters().mode());
}

// Feature: reduced resolution for speed
TEST(Matcher, ReturnsFullSizeMapsAtHalfResolution) {
  const Pair pair = test::slanted_pair(201, 91, 40, 3);
  Matcher matcher = test::matcher({{"preset", "fast"}, {"max-disparity", "61"}});
  const auto [map, confidence, statistics] = test::match(matcher, pair.left, pair.right);
  EXPECT_EQ(201, map.width);
  EXPECT_EQ(91, map.height);
  EXPECT_EQ(201, confidence.width);
  EXPECT_EQ(91, confidence.height);
  EXPECT_GT(statistics.density, 0.1);
  EXPECT_DOUBLE_EQ(test::known(map) / (201.0 * 91), statistics.density);
}

TEST(Matcher, KeepsTheLastResultWhenTheResolutionChanges) {
  const Pair pair = test::slanted_pair(120, 50, 20, 4);
  Matcher matcher = test::matcher({});
  for (const char* const next : {"half", "full", "half-refined", "half", "full"}) {
    const Result<FrameResult> result = matcher.compute(pair.left.view(), pair.right.view());
    ASSERT_TRUE(result.ok());
    const DisparityPlane map = copy_of(result->disparity);
    const test::GrayPlane confidence = copy_of(result->confidence);
    ASSERT_TRUE(matcher.set_parameters(test::parameters({{"resolution", next}})).ok());
    EXPECT_TRUE(same_image(map, result->disparity));
    EXPECT_TRUE(same_image(confidence, result->confidence));
  }
}

TEST(Matcher, AppliesParametersAtTheNextFrame) {
  const Pair pair = test::slanted_pair(160, 50, 20, 3);
  for (const test::ParameterSample& sample : test::parameter_samples()) {
    const ParameterInfo& info = *find_parameter(sample.name);
    Parameters base;
    for (const auto& [name, text] : sample.base) test::set_all(base, {{name, text}});
    Parameters changed = base;
    test::set_all(changed, {{sample.name, sample.other}});
    SCOPED_TRACE(info.name + (" = " + changed.text(info.id)));

    Matcher matcher = std::move(Matcher::create(base).value());
    const Result<FrameResult> result = matcher.compute(pair.left.view(), pair.right.view());
    ASSERT_TRUE(result.ok());
    const DisparityPlane before = copy_of(result->disparity);
    ASSERT_TRUE(matcher.set_parameters(changed).ok());
    EXPECT_TRUE(same_image(before, result->disparity))
        << "the last result must stay valid until the next frame";
    EXPECT_EQ(changed.text(info.id), matcher.parameters().text(info.id));

    const DisparityPlane after = test::compute(matcher, pair.left, pair.right);
    EXPECT_TRUE(same_image(matched_once(changed, pair), after));
    if (info.id != Parameter::kThreads && info.id != Parameter::kTemporal) {
      EXPECT_FALSE(same_image(before, after)) << "the change must change the result";
    }
    ASSERT_TRUE(matcher.set_parameters(base).ok());
    EXPECT_TRUE(same_image(before, test::compute(matcher, pair.left, pair.right)))
        << "after the change back";
  }
}

TEST(Matcher, DoesNotDependOnEarlierFrames) {
  const Pair pair = test::slanted_pair(130, 60, 20, 4);
  const Pair other = test::slanted_pair(130, 60, 20, 5);
  Matcher matcher = test::matcher({});
  const DisparityPlane first = test::compute(matcher, pair.left, pair.right);
  EXPECT_TRUE(same_image(first, test::compute(matcher, pair.left, pair.right)));
  test::compute(matcher, other.left, other.right);
  EXPECT_TRUE(same_image(first, test::compute(matcher, pair.left, pair.right)))
      << "after another frame";
}

TEST(Matcher, TakesFramesOfChangingSize) {
  Matcher matcher = test::matcher({{"max-disparity", "20"}});
  for (const auto& [width, height] : {std::pair{100, 40},
                                      {200, 90},
                                      {20, 1},
                                      {33, 200},
                                      {200, 90},
                                      {150, 90},
                                      {200, 90},
                                      {200, 33},
                                      {200, 90},
                                      {21, 21},
                                      {199, 89},
                                      {100, 40}}) {
    SCOPED_TRACE(testing::Message() << width << "x" << height);
    const Pair pair = test::slanted_pair(width, height, 18, width + height);
    EXPECT_TRUE(same_image(matched_once(matcher.parameters(), pair),
                           test::compute(matcher, pair.left, pair.right)));
  }
}

TEST(Matcher, DoesNotNeedTheInputAfterTheCall) {
  const Pair pair = test::slanted_pair(100, 40, 20, 6);
  Matcher matcher = test::matcher({{"cost", "gradient"}});
  auto temporary = std::make_unique<Pair>(pair);
  const Result<FrameResult> result =
      matcher.compute(temporary->left.view(), temporary->right.view());
  temporary.reset();
  ASSERT_TRUE(result.ok());
  EXPECT_TRUE(same_image(matched_once(matcher.parameters(), pair), result->disparity));
}

TEST(Matcher, AcceptsTheSameImageForBothViews) {
  const Pair pair = test::slanted_pair(100, 40, 20, 7);
  Matcher matcher = test::matcher({});
  const DisparityPlane map = test::compute(matcher, pair.left, pair.left);
  EXPECT_GT(test::known(map), 0);
  EXPECT_TRUE(same_image(map, matched_once(Parameters(), {pair.left, pair.left})));
}

TEST(Matcher, ReturnsStatisticsOfTheFrame) {
  const Pair pair = test::slanted_pair(150, 50, 20, 8);
  Matcher matcher = test::matcher({});
  const auto [map, confidence, statistics] = test::match(matcher, pair.left, pair.right);
  EXPECT_DOUBLE_EQ(test::known(map) / (150.0 * 50), statistics.density);
  EXPECT_GT(statistics.milliseconds, 0);
  const test::GrayPlane flat(150, 50, 90);
  EXPECT_EQ(0, test::match(matcher, flat, flat).statistics.density);
}

TEST(Matcher, CanBeMoved) {
  const Pair pair = test::slanted_pair(100, 40, 20, 9);
  Matcher first = test::matcher({});
  const DisparityPlane map = test::compute(first, pair.left, pair.right);
  Matcher second = std::move(first);
  EXPECT_TRUE(same_image(map, test::compute(second, pair.left, pair.right)));
  Matcher third = test::matcher({{"mode", "sparse"}});
  third = std::move(second);
  EXPECT_TRUE(same_image(map, test::compute(third, pair.left, pair.right)));
}

TEST(Version, IsThreeNumbers) {
  int major = 0, minor = 0, patch = 0, length = 0;
  ASSERT_EQ(3, std::sscanf(version(), "%d.%d.%d%n", &major, &minor, &patch, &length)) << version();
  EXPECT_EQ('\0', version()[length]) << version();
}

}  // namespace
}  // namespace mtstereo::matcher_test
