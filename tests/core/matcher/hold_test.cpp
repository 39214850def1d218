// SPDX-License-Identifier: LGPL-2.1-or-later
// temporal=hold: what the last pair of a stream changes, and when the matcher forgets it.
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "support/compare.hpp"
#include "support/matching.hpp"
#include "support/random.hpp"

namespace mtstereo::hold_test {
namespace {

using test::Matched;
using test::Pair;

constexpr const char* kModes[] = {"sparse", "semi-dense", "dense"};

/// A scene whose disparities are at the limit of what is kept if there is noise.
const Pair& scene() {
  static const Pair pair = test::slanted_pair(240, 120, 30, 1);
  return pair;
}

/// A frame of a camera at rest.
Pair frame(int number, const Pair& pair = scene()) {
  Pair noisy = pair;
  test::Random random(number + 1);
  for (test::GrayPlane* view : {&noisy.left, &noisy.right}) {
    for (std::uint8_t& pixel : view->pixels) {
      const int noise = random.between(-15, 15) + random.between(-15, 15);
      pixel = static_cast<std::uint8_t>(std::clamp(pixel + noise, 0, 255));
    }
  }
  return noisy;
}

Matched match(Matcher& matcher, const Pair& pair) {
  return test::match(matcher, pair.left, pair.right);
}

/// The map of a pair without a last one.
Matched alone(const Pair& pair, const char* mode = "semi-dense") {
  Matcher matcher = test::matcher({{"mode", mode}});
  return match(matcher, pair);
}

bool equal(const Matched& a, const Matched& b) {
  return a.map == b.map && a.confidence == b.confidence;
}

/// A matcher that holds the pixels of a stream.
Matcher holding(const char* mode = "semi-dense") {
  Matcher matcher = test::matcher({{"mode", mode}, {"temporal", "hold"}});
  EXPECT_TRUE(equal(alone(frame(0), mode), match(matcher, frame(0)))) << "the first pair";
  for (int i = 1; i < 4; ++i) match(matcher, frame(i));
  return matcher;
}

/// Of the pixels that any of six maps knows, the share that another one does not know.
struct Flicker {
  double come_and_go = 0;
  double density = 0;
};

/// A frame of a camera that moves by `speed` px along a flat scene: a crop of a wide pair.
Pair passing_frame(int number, int speed) {
  static const Pair wide = test::slanted_pair(300, 120, 30, 1);
  return frame(number, test::crop(wide, speed * number, 0, 240, 120));
}

Flicker flicker(Matcher& matcher, int speed) {
  constexpr int kMaps = 6;
  test::GrayPlane times(240 + speed * kMaps, 120);
  double any = 0, all = 0, sum = 0;
  for (int i = 10; i < 10 + kMaps; ++i) {
    const DisparityPlane map = match(matcher, passing_frame(i, speed)).map;
    for (int y = 0; y < map.height; ++y) {
      for (int x = 0; x < map.width; ++x) times(x + speed * (i - 10), y) += map(x, y) != 0;
    }
    sum += test::known(map) / (240.0 * 120.0);
  }
  for (int y = 0; y < 120; ++y) {
    for (int x = speed * kMaps; x < 240; ++x) {  // all maps see these
      any += times(x, y) > 0;
      all += times(x, y) == kMaps;
    }
  }
  return {(any - all) / any, sum / kMaps};
}

TEST(Hold, ReducesTheFlickerAndNotTheDensity) {
  for (const char* const mode : kModes) {
    for (const int speed : {0, 3}) {
      Matcher off = test::matcher({{"mode", mode}});
      Matcher hold = test::matcher({{"mode", mode}, {"temporal", "hold"}});
      for (int i = 6; i < 10; ++i) match(hold, passing_frame(i, speed));
      const Flicker before = flicker(off, speed), after = flicker(hold, speed);
      EXPECT_GT(before.come_and_go, 0.06) << mode << ": too little to compare";
      EXPECT_LT(after.come_and_go, 0.85 * before.come_and_go) << mode << ", " << speed;
      EXPECT_GT(after.density, before.density - 0.03) << mode << ", " << speed;
      const double most = mode == std::string("sparse") ? 1 : 0.02;
      EXPECT_LT(after.density, before.density + most) << mode << ", " << speed;
    }
  }
}

// Feature: filter of disparities over time
TEST(Hold, KeepsOnlyWhatThePresentPairChose) {
  for (const char* const mode : kModes) {
    // Without steps that infer disparities from those that are kept.
    const auto with = [&](const char* temporal, int least) {
      return test::matcher({{"mode", mode},
                            {"temporal", temporal},
                            {"min-confidence", std::to_string(least)},
                            {"max-gap", "0"},
                            {"thin-objects", "false"}});
    };
    Matcher hold = with("hold", 140), lower = with("off", 120), higher = with("off", 178);
    for (int i = 0; i < 4; ++i) {
      const Matched held = match(hold, frame(i));
      const Matched most = match(lower, frame(i)), least = match(higher, frame(i));
      for (std::size_t k = 0; k < held.map.pixels.size(); ++k) {
        const int disparity = held.map.pixels[k];
        ASSERT_TRUE(disparity == 0 || disparity == most.map.pixels[k]) << mode << ", pixel " << k;
        ASSERT_TRUE(disparity != 0 || least.map.pixels[k] == 0) << mode << ", pixel " << k;
      }
    }
  }
}

// Feature: steady maps of still scenes, and before a moving camera
TEST(Hold, IsOffAfterACut) {
  const Pair other = frame(7, test::slanted_pair(240, 120, 30, 8));
  for (const char* const mode : kModes) {
    Matcher matcher = holding(mode);
    EXPECT_TRUE(equal(alone(other, mode), match(matcher, other))) << mode;
  }
}

TEST(Hold, ForgetsAtEveryNewBeginning) {
  const Pair next = frame(20);
  Matcher kept = holding();
  EXPECT_FALSE(equal(alone(next), match(kept, next))) << "the test shows nothing";

  const std::vector<std::pair<const char*, std::function<void(Matcher&)>>> beginnings = {
      {"restart", [](Matcher& matcher) { matcher.restart(); }},
      {"forget", [](Matcher& matcher) { matcher.forget(); }},
      {"another size",
       [](Matcher& matcher) { match(matcher, test::slanted_pair(200, 100, 20, 2)); }},
      {"another parameter",
       [](Matcher& matcher) {
         for (const char* const least : {"100", "134"}) {
           const Parameters next =
               test::parameters({{"temporal", "hold"}, {"min-confidence", least}});
           ASSERT_TRUE(matcher.set_parameters(next).ok());
         }
       }},
      {"off and on", [](Matcher& matcher) {
         for (const char* const temporal : {"off", "hold"}) {
           ASSERT_TRUE(matcher.set_parameters(test::parameters({{"temporal", temporal}})).ok());
         }
       }}};
  for (const auto& [name, begin] : beginnings) {
    Matcher matcher = holding();
    begin(matcher);
    EXPECT_TRUE(equal(alone(next), match(matcher, next))) << name;
  }
}

TEST(Hold, GoesOnWithTheSameParametersAndAnotherCorrection) {
  const Pair next = frame(20);
  Matcher kept = holding(), corrected = holding(), same = holding();
  const Matched expected = match(kept, next);
  ASSERT_TRUE(same.set_parameters(Parameters(same.parameters())).ok());
  EXPECT_TRUE(equal(expected, match(same, next)));
  Matcher begun = test::matcher({{"temporal", "hold"}});
  for (Matcher* matcher : {&corrected, &begun}) {
    ASSERT_TRUE(matcher->set_correction({{1e-4, 0, 0, 0, 0}, 0, 0}).ok());
  }
  EXPECT_FALSE(equal(match(begun, next), match(corrected, next)));
}

TEST(Hold, IsTheSameForAnyNumberOfThreads) {
  std::vector<DisparityPlane> expected;
  for (const char* const threads : {"1", "2", "5"}) {
    Matcher matcher = test::matcher({{"temporal", "hold"}, {"threads", threads}});
    for (int i = 0; i < 4; ++i) {
      const DisparityPlane map = match(matcher, frame(i)).map;
      if (threads == std::string("1")) expected.push_back(map);
      EXPECT_TRUE(same_image(expected[i], map)) << threads << " threads, frame " << i;
    }
  }
}

TEST(Hold, ChangesNothingWhereNoConfidenceIsAskedOfTheCompleteMap) {
  for (const auto& [preset, mode] :
       {std::pair("default", "full"), {"fast", "full"}, {"paper", "dense"}}) {
    Matcher off = test::matcher({{"preset", preset}, {"mode", mode}});
    Matcher hold = test::matcher({{"preset", preset}, {"mode", mode}, {"temporal", "hold"}});
    for (int i = 0; i < 3; ++i) {
      EXPECT_TRUE(equal(match(off, frame(i)), match(hold, frame(i)))) << preset << ' ' << mode;
    }
  }
}

TEST(Hold, IsNoDefault) {
  for (const char* const preset : {"default", "fast", "paper"}) {
    EXPECT_EQ("off", test::parameters({{"preset", preset}}).text(Parameter::kTemporal));
  }
}

}  // namespace
}  // namespace mtstereo::hold_test
