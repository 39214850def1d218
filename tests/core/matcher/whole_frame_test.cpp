// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include "mtstereo/matcher.hpp"
#include "reference/frame.hpp"
#include "support/blocks.hpp"
#include "support/compare.hpp"
#include "support/matching.hpp"
#include "support/padded_image.hpp"
#include "support/parameter_samples.hpp"
#include "support/random.hpp"
#include "support/simd_targets.hpp"
#include "support/watching.hpp"

namespace mtstereo::whole_frame_test {
namespace {

/// Random values of all parameters, chosen to fit images of this width.
Parameters random_parameters(int width, Random& random) {
  Parameters parameters;
  for (const test::ParameterSample& sample : test::parameter_samples()) {
    const auto value =
        static_cast<std::size_t>(random.below(static_cast<int>(sample.values.size())));
    test::set_all(parameters, {{sample.name, sample.values[value]}});
  }
  const int most = random.between(1, width);
  const int least = random.below(3) == 0 ? random.between(-12, most - 1) : 0;
  test::set_all(parameters, {{"max-disparity", std::to_string(most)},
                             {"min-disparity", std::to_string(least)}});
  if (width <= 24) test::set_all(parameters, {{"min-node-width", "0"}});
  return parameters;
}

std::string text_of(const Parameters& parameters) {
  std::string text;
  for (const ParameterInfo& info : parameter_table()) {
    text += std::string(info.name) + "=" + parameters.text(info.id) + " ";
  }
  return text;
}

/// Compares the disparities at the ends of the leaves with those of the drawn leaves.
void expect_ends(const reference::Frame& expected, const Nodes& nodes) {
  const NodeLevel& leaves = nodes.leaves().left;
  for (int y = 0; y < leaves.height; ++y) {
    for (int i = 0; i < leaves.count[y]; ++i) {
      const std::size_t leaf = leaves.first[y] + i;
      ASSERT_EQ(expected.nodes(leaves.begin[leaf], y), nodes.ends.begin[leaf]) << i << ", " << y;
      ASSERT_EQ(expected.nodes(leaves.end[leaf], y), nodes.ends.end[leaf]) << i << ", " << y;
    }
  }
}

/// Compares the results of a step with those of its scalar version.
void expect_step(const reference::Frame& expected, const Step& step, const FrameMemory& memory) {
  SCOPED_TRACE(testing::Message() << "after " << step.name);
  for (int side = 0; side < 2; ++side) {
    if (step.name == "halving") {
      EXPECT_TRUE(same_image(expected.views[side], memory.views.matched[side]));
    } else if (step.name == "preprocessing") {
      EXPECT_TRUE(same_image(expected.levels[side], memory.nodes.preprocessed[side].level.view()));
    }
  }
  if (step.name == "cost-volume") {
    for (int d = 0; d < expected.volume.disparities(); ++d) {
      EXPECT_TRUE(test::same_pixels(
          expected.views[0].width, expected.views[0].height,
          [&](int x, int y) { return d <= x ? int{expected.volume.at(x, y, d)} : 0; },
          [&](int x, int y) { return d <= x ? int{memory.costs.volume.at(x, y, d)} : 0; }))
          << "costs of disparity " << d;
    }
  }
  if (step.name == "time-filter") {
    EXPECT_EQ(expected.past.averaged, memory.past.averaged);
    for (int side = 0; side < 2; ++side) {
      EXPECT_TRUE(same_image(expected.input[side], memory.views.input[side]));
    }
  }
  if (step.name == "node-matching") expect_ends(expected, memory.nodes);
  const DisparityView map = test::map_after(step, memory);
  if (map.width > 0) {
    EXPECT_TRUE(same_image(expected.map, map));
  }
  if (step.name == "confidence") {
    EXPECT_TRUE(same_image(expected.confidence, memory.maps.confidence.view()));
  }
}

/// What the scalar versions know of the pairs before.
struct Past {
  reference::PastViews views;
  test::DisparityPlane last;
};

/// Matches a pair and compares it with the scalar versions step by step. Returns the map.
test::DisparityPlane expect_reference(FrameMatcher& matcher, const test::Pair& pair, GrayView left,
                                      GrayView right, Past& past) {
  reference::Frame expected(pair.left, pair.right, matcher.settings());
  expected.past = past.views;
  expected.last = past.last;
  const auto compare = [&](const Step& step, const FrameMemory& memory) {
    // camera_motion_test.cpp compares the motions with true ones.
    if (step.name == "time-filter") expected.followed = memory.past.motion;
    if (step.name == "camera-motion") expected.motion = memory.last.motion;
    reference::run(step.name, expected);
    expect_step(expected, step, memory);
  };
  const FrameResult result = matcher.compute(left, right, compare);
  EXPECT_TRUE(same_image(expected.map, result.disparity));
  EXPECT_TRUE(same_image(expected.confidence, result.confidence));
  past = {expected.past, expected.kept};
  return expected.map;
}
test::DisparityPlane expect_reference(FrameMatcher& matcher, const test::Pair& pair, GrayView left,
                                      GrayView right) {
  Past past;
  return expect_reference(matcher, pair, left, right, past);
}

/// A random pair, sometimes of unrelated views.
test::Pair random_pair(int width, int height, Random& random) {
  switch (random.below(7)) {
    case 0:
      return {test::noise(width, height, random.next()), test::noise(width, height, random.next())};
    case 1:
      return test::shifted_pair(width, height, random.below(width), random.next());
    case 2:
      return test::with_blocks(test::shifted_pair(width, height, 2, random.next()));
    default:
      return test::slanted_pair(width, height, std::max(width / 3, 1), random.next());
  }
}

/// Compares one matcher with the reference over frames of changing size and parameters. Returns the
/// number of disparities found.
long expect_reference_frames(int frames, std::uint64_t seed) {
  Random random(seed);
  FrameMatcher matcher{Settings(Parameters())};
  long found = 0;
  for (int frame = 0; frame < frames && !testing::Test::HasFailure(); ++frame) {
    const int width = random.between(1, random.below(3) == 0 ? 8 : 75);
    const int height = random.between(1, 45);
    const Parameters parameters = random_parameters(width, random);
    SCOPED_TRACE(testing::Message() << "frame " << frame << " of seed " << seed << ", " << width
                                    << "x" << height << ": " << text_of(parameters));
    const test::Pair pair = random_pair(width, height, random);
    const test::PaddedImage<std::uint8_t> left(pair.left, random.below(70), random.below(9));
    const test::PaddedImage<std::uint8_t> right(pair.right, random.below(70), random.below(9));
    if (!parameters.check_frame(width, height).ok()) continue;
    matcher.set(Settings(parameters));
    matcher.forget();
    Past past;
    found += test::known(expect_reference(matcher, pair, left.view(), right.view(), past));
    if (matcher.settings().temporal != Temporal::kOff) {
      const test::Pair next = test::with_noise(pair, random, 1);
      expect_reference(matcher, next, next.left.view(), next.right.view(), past);
    }
    EXPECT_TRUE(left.unchanged() && right.unchanged()) << "the input was written to";
  }
  return found;
}

/// In parts, of which emulated processors run the first.
class RandomFrames : public testing::TestWithParam<std::uint64_t> {};
INSTANTIATE_TEST_SUITE_P(Parts, RandomFrames, testing::Range(std::uint64_t{0}, std::uint64_t{3}));

TEST_P(RandomFrames, EqualReferenceWithAnyParametersAndSizes) {
  constexpr std::uint64_t kSeeds = 4;
  const std::uint64_t first = 1 + kSeeds * GetParam();
  long found = 0;
  for (std::uint64_t seed = first; seed < first + kSeeds; ++seed) {
    found += expect_reference_frames(60, seed);
  }
  EXPECT_GT(found, 4000) << "too few results to compare";
}

constexpr const char* kPresetNames[] = {"default", "fast", "paper"};
constexpr const char* kModeNames[] = {"sparse", "semi-dense", "dense", "full"};

TEST(WholeFrame, EqualsReferenceWithTheDefaultsOfAllModes) {
  for (const char* const preset : kPresetNames) {
    for (const char* const mode : kModeNames) {
      SCOPED_TRACE(testing::Message() << "preset " << preset << ", mode " << mode);
      const Parameters parameters =
          test::parameters({{"preset", preset}, {"mode", mode}, {"max-disparity", "40"}});
      const test::Pair sharp = test::slanted_pair(180, 70, 30, 9);
      test::Pair dark = sharp;
      for (GrayPlane* view : {&dark.left, &dark.right}) {
        for (std::uint8_t& pixel : view->pixels) pixel /= 6;
      }
      for (const test::Pair& pair : {sharp, dark, test::with_blocks(sharp)}) {
        FrameMatcher matcher{Settings(parameters)};
        const test::DisparityPlane map =
            expect_reference(matcher, pair, pair.left.view(), pair.right.view());
        EXPECT_GT(test::known(map), 100);
      }
    }
  }
}

/// Posts in front of a background, 16 px nearer.
test::Pair posts() {
  test::Pair pair = test::shifted_pair(200, 90, 4, 21);
  for (int y = 10; y < 85; ++y) {
    for (int post = 0; post < 5; ++post) {
      for (int i = 0; i < 4 + post; ++i) {
        const int x = 36 + 32 * post + i + y / 8;
        const auto gray = static_cast<std::uint8_t>(post % 2 == 0 ? 250 : 3);
        pair.left(x, y) = pair.right(x - 20, y) = gray;
      }
    }
  }
  return pair;
}

TEST(WholeFrame, EqualsReferenceWithThinObjects) {
  const test::Pair pair = posts();
  const auto map_of = [&](const char* mode, const char* thin) {
    const Parameters parameters =
        test::parameters({{"mode", mode}, {"max-disparity", "40"}, {"thin-objects", thin}});
    FrameMatcher matcher{Settings(parameters)};
    return expect_reference(matcher, pair, pair.left.view(), pair.right.view());
  };
  const auto near = [](const test::DisparityPlane& map) {
    return std::count_if(map.pixels.begin(), map.pixels.end(), [](int d) { return d > 18 * 256; });
  };
  for (const char* const mode : {"semi-dense", "dense"}) {
    EXPECT_GT(near(map_of(mode, "true")), near(map_of(mode, "false")) + 50) << mode;
  }
}

/// Compares frames of a camera at rest, before which something moves.
void expect_reference_sequence(const Parameters& parameters) {
  SCOPED_TRACE(text_of(parameters));
  FrameMatcher matcher{Settings(parameters)};
  Random random(4);
  const test::Pair scene = test::slanted_pair(140, 60, 30, 9);
  Past past;
  for (int frame = 0; frame < 4; ++frame) {
    test::Pair pair = test::with_noise(scene, random, 1);
    for (int x = 0; x < 30; ++x) pair.left(x, 30) = static_cast<std::uint8_t>(60 * frame);
    const test::DisparityPlane map =
        expect_reference(matcher, pair, pair.left.view(), pair.right.view(), past);
    const Settings& settings = matcher.settings();
    const bool few = settings.mode == Mode::kSparse && settings.half();
    EXPECT_GT(test::known(map), few ? 400 : 1000);
  }
}

// Every pair of values of two parameters, not every combination: each runs the scalar version for
// seconds.
TEST(WholeFrame, EqualsReferenceInASequence) {
  const char* const least[] = {"-8", "0", "8"};
  std::size_t turn = 0;
  for (const char* const temporal : {"hold", "filter"}) {
    for (const char* const resolution : {"full", "half-refined"}) {
      for (const char* const mode : {"sparse", "semi-dense", "dense"}) {
        expect_reference_sequence(test::parameters({{"mode", mode},
                                                    {"resolution", resolution},
                                                    {"min-disparity", least[turn++ % 3]},
                                                    {"max-disparity", "40"},
                                                    {"temporal", temporal}}));
      }
      ++turn;
    }
  }
}

TEST(WholeFrame, EqualsReferenceBeforeAMovingCamera) {
  for (const auto& [mode, resolution, least] :
       {std::tuple("semi-dense", "full", "0"), {"full", "full", "-8"}, {"dense", "half", "8"}}) {
    SCOPED_TRACE(testing::Message() << mode << ", " << resolution);
    FrameMatcher matcher{Settings(test::parameters({{"mode", mode},
                                                    {"resolution", resolution},
                                                    {"min-disparity", least},
                                                    {"max-disparity", "40"},
                                                    {"temporal", "filter"}}))};
    Past past;
    int followed = 0;
    for (const test::Pair& pair : test::moving_frames(4, 181, 83)) {
      expect_reference(matcher, pair, pair.left.view(), pair.right.view(), past);
      followed += past.views.followed;
    }
    EXPECT_EQ(3, followed);
  }
}

/// Compares the results of a matcher with these parameters on every SIMD target.
void expect_same_on_every_target(const Parameters& parameters) {
  SCOPED_TRACE(text_of(parameters));
  const test::Pair pair = test::slanted_pair(211, 101, 40, 10);
  test::Matched expected;
  test::for_each_simd_target([&] {
    Matcher matcher = std::move(Matcher::create(parameters).value());
    const test::Matched matched = test::match(matcher, pair.left, pair.right);
    if (expected.map.width == 0) expected = matched;
    EXPECT_TRUE(same_image(expected.map, matched.map));
    EXPECT_TRUE(same_image(expected.confidence, matched.confidence));
  });
  EXPECT_GT(test::known(expected.map), 1000);
}

TEST(WholeFrame, HasTheSameResultOnEveryInstructionSet) {
  for (const char* const preset : kPresetNames) {
    for (const char* const volume : {"half", "full"}) {
      expect_same_on_every_target(test::parameters({{"preset", preset}, {"cost-volume", volume}}));
    }
  }
  for (const char* const size : {"1", "3"}) {
    expect_same_on_every_target(
        test::parameters({{"mode", "dense"}, {"census-kernel-size", size}}));
  }
}

}  // namespace
}  // namespace mtstereo::whole_frame_test
