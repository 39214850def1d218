// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mtstereo/matcher.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <memory>
#include <utility>
#include <vector>

#include "mtstereo/mtstereo.hpp"
#include "support/compare.hpp"
#include "support/matching.hpp"
#include "support/random.hpp"

namespace mtstereo {
namespace {

using test::copy_of;
using test::DisparityPlane;
using test::Pair;
using test::same_image;

constexpr Stage kAllStages[] = {Stage::kNodeMatching, Stage::kNodesFiltered, Stage::kExtrapolated,
                                Stage::kPixelMatching, Stage::kFinal};

/// What a matcher of its own says to a pair.
DisparityPlane alone(const Parameters& parameters, const Pair& pair) {
  Result<Matcher> matcher = Matcher::create(parameters);
  EXPECT_TRUE(matcher.ok());
  return test::compute(*matcher, pair.left, pair.right);
}

TEST(Matcher, KeepsTheParametersThatItIsMadeWith) {
  const Matcher matcher = test::matcher({{"max-disparity", "77"}, {"mode", "sparse"}});
  EXPECT_EQ(77, matcher.parameters().integer(Parameter::kMaxDisparity));
  EXPECT_EQ(Mode::kSparse, matcher.parameters().mode());
}

TEST(Matcher, ShowsNothingBeforeTheFirstFrame) {
  const Matcher matcher = test::matcher({});
  for (const Stage stage : kAllStages) {
    EXPECT_EQ(0, matcher.stage(stage).width);
    EXPECT_EQ(0, matcher.stage(stage).height);
  }
  for (const Side side : {Side::kLeft, Side::kRight}) {
    EXPECT_EQ(0, matcher.preprocessed(side).width);
    EXPECT_EQ(0, matcher.preprocessed(side).height);
  }
  EXPECT_EQ(0, matcher.confidence().width);
  EXPECT_EQ(0, matcher.confidence().height);
  EXPECT_EQ(0, matcher.cost(0, 0, 0));
  EXPECT_EQ(0, matcher.statistics().density);
  EXPECT_EQ(0, matcher.statistics().milliseconds);
}

TEST(Matcher, KeepsTheStagesOnlyWhereAsked) {
  const Pair pair = test::slanted_pair(120, 40, 20, 1);
  Matcher matcher = test::matcher({});
  test::compute(matcher, pair.left, pair.right);
  for (const Stage stage : kAllStages) EXPECT_EQ(0, matcher.stage(stage).width) << "off at first";

  matcher.keep_stages(true);
  const DisparityPlane map = test::compute(matcher, pair.left, pair.right);
  for (const Stage stage : kAllStages) {
    EXPECT_EQ(120, matcher.stage(stage).width);
    EXPECT_EQ(40, matcher.stage(stage).height);
  }
  EXPECT_TRUE(same_image(map, matcher.stage(Stage::kFinal)));
  EXPECT_FALSE(same_image(map, matcher.stage(Stage::kNodeMatching)));

  matcher.keep_stages(false);
  test::compute(matcher, pair.right, pair.left);
  for (const Stage stage : kAllStages) {
    EXPECT_EQ(0, matcher.stage(stage).width) << "they are not those of the last frame";
    EXPECT_EQ(0, matcher.stage(stage).height);
  }
}

TEST(Matcher, AtHalfResolutionShowsStagesOfHalfTheSizeAndAResultOfTheViews) {
  const Pair pair = test::slanted_pair(201, 91, 40, 3);
  Matcher matcher =
      test::matcher({{"preset", "fast"}, {"max-disparity", "61"}, {"node-cost", "gradient"}});
  matcher.keep_stages(true);
  const DisparityPlane map = test::compute(matcher, pair.left, pair.right);
  EXPECT_EQ(201, map.width);
  EXPECT_EQ(91, map.height);
  EXPECT_EQ(201, matcher.confidence().width);
  EXPECT_EQ(91, matcher.confidence().height);
  EXPECT_GT(matcher.statistics().density, 0.1);
  EXPECT_DOUBLE_EQ(test::known(map) / (201.0 * 91), matcher.statistics().density);
  for (const Stage stage : kAllStages) {
    EXPECT_EQ(101, matcher.stage(stage).width);
    EXPECT_EQ(46, matcher.stage(stage).height);
  }
  for (const Side side : {Side::kLeft, Side::kRight}) {
    EXPECT_EQ(101, matcher.preprocessed(side).width);
    EXPECT_EQ(46, matcher.preprocessed(side).height);
  }
  const test::GrayPlane black(201, 91, 0), white(201, 91, 255);
  test::compute(matcher, black, white);
  EXPECT_GT(matcher.cost(100, 45, 30), 0);
  for (const auto& [x, y, d] : {std::array{101, 45, 30}, {100, 46, 30}, {100, 45, 31}}) {
    EXPECT_EQ(matcher.cost(x, y, d), 0) << x << ", " << y << ", " << d;
  }
}

TEST(Matcher, HoldsTheLastResultWhileTheResolutionChanges) {
  const Pair pair = test::slanted_pair(120, 50, 20, 4);
  Matcher matcher = test::matcher({});
  for (const char* const next : {"half", "full", "half-refined", "half", "full"}) {
    const Result<DisparityView> view = matcher.compute(pair.left.view(), pair.right.view());
    ASSERT_TRUE(view.ok());
    const DisparityPlane map = copy_of(*view);
    const test::GrayPlane confidence = copy_of(matcher.confidence());
    ASSERT_TRUE(matcher.set_parameters(test::parameters({{"resolution", next}})).ok());
    EXPECT_TRUE(same_image(map, *view));
    EXPECT_TRUE(same_image(confidence, matcher.confidence()));
    EXPECT_EQ(0, matcher.cost(50, 20, 10)) << "until the next frame";
  }
}

TEST(Matcher, GivesTheSameWithAndWithoutStages) {
  const Pair pair = test::slanted_pair(150, 50, 20, 2);
  Matcher with = test::matcher({}), without = test::matcher({});
  with.keep_stages(true);
  EXPECT_TRUE(same_image(test::compute(without, pair.left, pair.right),
                         test::compute(with, pair.left, pair.right)));
}

/// A set of parameters, and another value of one of them whose change shows in it.
struct Change {
  std::vector<std::pair<const char*, std::string>> base;
  const char* value;
};

Change change_of(Parameter id) {
  switch (id) {
    case Parameter::kPreset:
      return {{}, "paper"};
    case Parameter::kMode:
      return {{}, "sparse"};
    case Parameter::kMaxDisparity:
      return {{}, "15"};
    case Parameter::kResolution:
      return {{}, "half"};
    case Parameter::kThreads:
      return {{}, "3"};
    case Parameter::kMaxNodeWidth:
      return {{{"preset", "paper"}}, "0.05"};
    case Parameter::kIntensityWeight:
      return {{{"preset", "paper"}}, "0.2"};
    case Parameter::kNodeLevels:
      return {{{"preset", "paper"}}, "0"};
    case Parameter::kMedianFilter:
      return {{{"preset", "paper"}}, "trees"};
    case Parameter::kCostVolume:
      return {{{"preset", "paper"}}, "full"};
    case Parameter::kOutlierRemoval:  // with costs that leave outliers
      return {{{"preset", "paper"},
               {"pixel-cost", "census"},
               {"census-kernel-size", "1"},
               {"large-step-penalty", "0"},
               {"range-penalty", "0"},
               {"pixel-confidence", "0"},
               {"between-nodes", "all"}},
              "nodes"};
    case Parameter::kNodeCost:
    case Parameter::kPixelCost:
      return {{}, "gradient"};
    case Parameter::kPixelSearchRange:
      return {{{"preset", "paper"}}, "90"};
    case Parameter::kBetweenNodes:
      return {{}, "none"};
    case Parameter::kRangePenalty:
      return {{{"min-confidence", "0"}}, "24"};
    case Parameter::kPixelConfidence:
      return {{}, "60"};
    case Parameter::kRunnerUp:
      return {{{"preset", "paper"}}, "any"};
    case Parameter::kLeftRightTolerance:
      return {{}, "0"};
    case Parameter::kSubpixel:
      return {{}, "false"};
    case Parameter::kSpeckleSize:
      return {{}, "65535"};
    case Parameter::kNodeEndWidth:
      return {{{"mode", "sparse"}}, "1"};
    case Parameter::kMaxGap:
      return {{{"mode", "dense"}}, "0"};
    case Parameter::kCensusKernelSize:
    case Parameter::kSmallStepPenalty:
    case Parameter::kLargeStepPenalty:
    case Parameter::kMinConfidence:
    case Parameter::kRimTrim:
    case Parameter::kSmoothingRadius:
      return {{}, "3"};
    default:
      return {{{"preset", "paper"}}, "3"};
  }
}

TEST(Matcher, TakesParametersAtTheNextFrame) {
  const Pair pair = test::slanted_pair(160, 50, 20, 3);
  for (const ParameterInfo& info : parameter_table()) {
    const Change change = change_of(info.id);
    Parameters base;
    for (const auto& [name, text] : change.base) test::set_all(base, {{name, text}});
    Parameters changed = base;
    ASSERT_TRUE(changed.set(info.id, std::string_view(change.value)).ok()) << info.name;
    SCOPED_TRACE(info.name + (" = " + changed.text(info.id)));

    Matcher matcher = std::move(Matcher::create(base).value());
    const Result<DisparityView> view = matcher.compute(pair.left.view(), pair.right.view());
    ASSERT_TRUE(view.ok());
    const DisparityPlane before = copy_of(*view);
    ASSERT_TRUE(matcher.set_parameters(changed).ok());
    EXPECT_TRUE(same_image(before, *view)) << "the last result holds until the next frame";
    EXPECT_EQ(changed.text(info.id), matcher.parameters().text(info.id));

    const DisparityPlane after = test::compute(matcher, pair.left, pair.right);
    EXPECT_TRUE(same_image(alone(changed, pair), after));
    if (info.id != Parameter::kThreads) {
      EXPECT_FALSE(same_image(before, after)) << "the change is seen";
    }
    ASSERT_TRUE(matcher.set_parameters(base).ok());
    EXPECT_TRUE(same_image(before, test::compute(matcher, pair.left, pair.right))) << "and back";
  }
}

TEST(Matcher, GivesTheSameForTheSameFrame) {
  const Pair pair = test::slanted_pair(130, 60, 20, 4);
  const Pair other = test::slanted_pair(130, 60, 20, 5);
  Matcher matcher = test::matcher({});
  const DisparityPlane first = test::compute(matcher, pair.left, pair.right);
  EXPECT_TRUE(same_image(first, test::compute(matcher, pair.left, pair.right)));
  test::compute(matcher, other.left, other.right);
  EXPECT_TRUE(same_image(first, test::compute(matcher, pair.left, pair.right)))
      << "nothing is left of the frame before";
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
    EXPECT_TRUE(same_image(alone(matcher.parameters(), pair),
                           test::compute(matcher, pair.left, pair.right)));
  }
}

TEST(Matcher, DoesNotNeedTheInputAfterTheCall) {
  const Pair pair = test::slanted_pair(100, 40, 20, 6);
  Matcher matcher = test::matcher({{"node-cost", "gradient"}});
  auto gone = std::make_unique<Pair>(pair);
  const Result<DisparityView> view = matcher.compute(gone->left.view(), gone->right.view());
  gone.reset();
  ASSERT_TRUE(view.ok());
  EXPECT_TRUE(same_image(alone(matcher.parameters(), pair), *view));
  EXPECT_GT(matcher.cost(50, 20, 10), 0);
}

TEST(Matcher, TakesTheSameImageForBothViews) {
  const Pair pair = test::slanted_pair(100, 40, 20, 7);
  Matcher matcher = test::matcher({});
  const Result<DisparityView> view = matcher.compute(pair.left.view(), pair.left.view());
  ASSERT_TRUE(view.ok());
  const DisparityPlane map = copy_of(*view);
  EXPECT_GT(test::known(map), 0);
  EXPECT_TRUE(same_image(map, alone(Parameters(), {pair.left, pair.left})));
}

TEST(Matcher, CountsItsFrame) {
  const Pair pair = test::slanted_pair(150, 50, 20, 8);
  Matcher matcher = test::matcher({});
  const DisparityPlane map = test::compute(matcher, pair.left, pair.right);
  EXPECT_DOUBLE_EQ(test::known(map) / (150.0 * 50), matcher.statistics().density);
  EXPECT_GT(matcher.statistics().milliseconds, 0);
  const test::GrayPlane flat(150, 50, 90);
  test::compute(matcher, flat, flat);
  EXPECT_EQ(0, matcher.statistics().density);
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

TEST(Matcher, ShowsTheCostsOfTheLastFrame) {
  const test::GrayPlane black(80, 20, 0), white(80, 20, 255);
  Matcher matcher = test::matcher({{"max-disparity", "10"}, {"node-cost", "gradient"}});
  test::compute(matcher, black, white);
  // Nothing but the gray values differs, and their weight is 0.30.
  for (const auto& [x, y, d] : {std::tuple{0, 0, 0}, {79, 19, 9}, {40, 10, 5}}) {
    EXPECT_NEAR(0.30 * 255, matcher.cost(x, y, d), 0.5) << x << ", " << y << ", " << d;
  }
  test::compute(matcher, white, white);
  EXPECT_EQ(0, matcher.cost(40, 10, 5));
  test::compute(matcher, black, white);
  ASSERT_TRUE(matcher.set_parameters(test::parameters({{"max-disparity", "10"}})).ok());
  test::compute(matcher, black, white);
  EXPECT_EQ(0, matcher.cost(40, 10, 5)) << "there is no volume any more";
}

TEST(Version, IsThreeNumbers) {
  int major = 0, minor = 0, patch = 0, length = 0;
  ASSERT_EQ(3, std::sscanf(version(), "%d.%d.%d%n", &major, &minor, &patch, &length)) << version();
  EXPECT_EQ('\0', version()[length]) << version();
}

TEST(Matcher, ACostOutsideOfTheImageIsNone) {
  const Pair pair = test::slanted_pair(90, 40, 12, 3);
  Matcher matcher = std::move(
      Matcher::create(test::parameters({{"max-disparity", "16"}, {"node-cost", "gradient"}}))
          .value());
  test::compute(matcher, pair.left, pair.right);
  EXPECT_GT(matcher.cost(89, 39, 15), 0);
  for (const auto& [x, y, d] : {std::array{-1, 0, 0},
                                {90, 0, 0},
                                {0, -1, 0},
                                {0, 40, 0},
                                {50, 20, -1},
                                {50, 20, 16},
                                {5, 20, 6},
                                {100000, 100000, 3}}) {
    EXPECT_EQ(matcher.cost(x, y, d), 0) << x << ", " << y << ", " << d;
  }
}

}  // namespace
}  // namespace mtstereo
