// SPDX-License-Identifier: LGPL-2.1-or-later
// temporal=filter: what the views of a stream so far change, and when the matcher forgets them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "support/matching.hpp"
#include "support/random.hpp"

namespace mtstereo::filter_test {
namespace {

using test::Matched;
using test::Pair;

/// The maps of a stream depend on its frames with this preset and mode.
struct Kind {
  const char* preset;
  const char* mode;
};
constexpr Kind kKinds[] = {{"default", "sparse"},  {"default", "semi-dense"},
                           {"default", "dense"},   {"default", "full"},
                           {"fast", "semi-dense"}, {"paper", "semi-dense"}};

constexpr int kDisparity = 12;

/// A pair with the noise of a frame.
Pair frame(int number, Pair pair) {
  test::Random random(number + 1);
  for (test::GrayPlane* view : {&pair.left, &pair.right}) {
    for (std::uint8_t& pixel : view->pixels) {
      const int noise = random.between(-12, 12) + random.between(-12, 12);
      pixel = static_cast<std::uint8_t>(std::clamp(pixel / 2 + 64 + noise, 0, 255));
    }
  }
  return pair;
}

/// A frame of a camera at rest.
Pair frame(int number, int scene = 1) {
  return frame(number, test::shifted_pair(240, 120, kDisparity, scene));
}

Matcher matcher(const Kind& kind, const char* temporal, const char* threads = "2") {
  return test::matcher(
      {{"preset", kind.preset}, {"mode", kind.mode}, {"temporal", temporal}, {"threads", threads}});
}

Matched match(Matcher& matcher, const Pair& pair) {
  return test::match(matcher, pair.left, pair.right);
}

Matched alone(const Kind& kind, const Pair& pair) {
  Matcher off = matcher(kind, "off");
  return match(off, pair);
}

bool equal(const Matched& a, const Matched& b) {
  return a.map == b.map && a.confidence == b.confidence;
}

/// A matcher that knows a stream of some frames.
Matcher filtering(const Kind& kind) {
  Matcher filter = matcher(kind, "filter");
  EXPECT_TRUE(equal(alone(kind, frame(0)), match(filter, frame(0)))) << "the first pair";
  for (int i = 1; i < 4; ++i) match(filter, frame(i));
  return filter;
}

/// Mean error of the known disparities [px].
double error(const Matched& matched) {
  double sum = 0, known = 0;
  for (const int disparity : matched.map.pixels) {
    if (disparity == 0) continue;
    sum += std::abs(disparity / 256.0 - kDisparity);
    ++known;
  }
  return sum / known;
}

TEST(Filter, ReducesTheErrorsOfNoise) {
  for (const Kind& kind : kKinds) {
    Matcher filter = filtering(kind);
    const Matched before = alone(kind, frame(9)), after = match(filter, frame(9));
    EXPECT_LT(error(after), 0.9 * error(before)) << kind.preset << ' ' << kind.mode;
  }
}

TEST(Filter, FollowsAMovingCamera) {
  for (const Kind& kind : kKinds) {
    if (kind.preset != std::string("default")) continue;  // halving averages, paper has no map
    const Pair wide = test::shifted_pair(300, 140, kDisparity, 1);
    Matcher filter = matcher(kind, "filter"), off = matcher(kind, "off");
    double before = 0, after = 0;
    for (int i = 0; i < 8; ++i) {
      const Pair crop = frame(i, test::crop(wide, 5 * i, 2 * i, 240, 120));
      before = error(match(off, crop));
      after = error(match(filter, crop));
    }
    EXPECT_LT(after, 0.9 * before) << kind.preset << ' ' << kind.mode;
  }
}

TEST(Filter, IsOffAfterACut) {
  for (const Kind& kind : kKinds) {
    Matcher filter = filtering(kind);
    const Pair other = frame(7, 8);
    EXPECT_TRUE(equal(alone(kind, other), match(filter, other))) << kind.preset << ' ' << kind.mode;
    EXPECT_FALSE(equal(alone(kind, frame(8, 8)), match(filter, frame(8, 8)))) << "it goes on";
  }
}

TEST(Filter, IsOffIfOneViewChanges) {
  const Kind kind = kKinds[1];
  for (const bool left : {false, true}) {
    Matcher filter = filtering(kind);
    Pair pair = frame(9);
    test::GrayPlane& view = left ? pair.left : pair.right;
    for (int y = 0; y < 40; ++y) {
      for (int x = 0; x < view.width; ++x) view(x, y) = static_cast<std::uint8_t>(x * y);
    }
    const int known = test::known(match(filter, pair).map);
    EXPECT_NEAR(known, test::known(alone(kind, pair).map), 0.02 * 240 * 120);
  }
}

TEST(Filter, ForgetsAtEveryNewBeginning) {
  const Kind kind = kKinds[1];
  const Pair next = frame(20);
  Matcher kept = filtering(kind);
  EXPECT_FALSE(equal(alone(kind, next), match(kept, next))) << "the test shows nothing";

  const std::vector<std::pair<const char*, std::function<void(Matcher&)>>> beginnings = {
      {"restart", [](Matcher& matcher) { matcher.restart(); }},
      {"forget", [](Matcher& matcher) { matcher.forget(); }},
      {"another size",
       [](Matcher& matcher) { match(matcher, test::slanted_pair(200, 100, 20, 2)); }},
      {"another parameter",
       [](Matcher& matcher) {
         for (const char* const least : {"100", "134"}) {
           const Parameters next = test::parameters(
               {{"temporal", "filter"}, {"min-confidence", least}, {"threads", "2"}});
           ASSERT_TRUE(matcher.set_parameters(next).ok());
         }
       }},
      {"hold and filter", [](Matcher& matcher) {
         for (const char* const temporal : {"hold", "filter"}) {
           match(matcher, frame(5));
           const Parameters next = test::parameters({{"temporal", temporal}, {"threads", "2"}});
           ASSERT_TRUE(matcher.set_parameters(next).ok());
         }
       }}};
  for (const auto& [name, begin] : beginnings) {
    Matcher matcher = filtering(kind);
    begin(matcher);
    EXPECT_TRUE(equal(alone(kind, next), match(matcher, next))) << name;
  }
}

TEST(Filter, IsTheSameForAnyNumberOfThreadsAndBesideAnotherMatcher) {
  for (const Kind& kind : kKinds) {
    std::vector<Matched> expected;
    Matcher other = matcher(kind, "filter");
    for (const char* const threads : {"1", "2", "5"}) {
      Matcher filter = matcher(kind, "filter", threads);
      for (int i = 0; i < 4; ++i) {
        match(other, frame(i, 3));
        const Matched matched = match(filter, frame(i));
        if (threads == std::string("1")) expected.push_back(matched);
        EXPECT_TRUE(equal(expected[i], matched)) << threads << " threads, frame " << i;
      }
    }
  }
}

}  // namespace
}  // namespace mtstereo::filter_test
