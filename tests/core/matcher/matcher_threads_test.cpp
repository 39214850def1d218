// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <thread>

#include "support/compare.hpp"
#include "support/matching.hpp"
#include "support/random.hpp"
#include "support/watching.hpp"

namespace mtstereo::matcher_threads_test {
namespace {

using test::Pair;

/// Matches with this many threads and with one; the results of every step must be equal.
void expect_same_as_one_thread(const Pair& pair, Parameters parameters, int threads) {
  SCOPED_TRACE(testing::Message() << pair.left.width << "x" << pair.left.height << ", " << threads
                                  << " threads");
  ASSERT_TRUE(parameters.set(Parameter::kThreads, 1).ok());
  FrameMatcher one{Settings(parameters)};
  ASSERT_TRUE(parameters.set(Parameter::kThreads, threads).ok());
  FrameMatcher many{Settings(parameters)};
  const test::StepMaps expected = test::maps_after_steps(one, pair.left, pair.right);
  EXPECT_GT(test::known(expected.back().second), 0);
  const FrameResult result = one.compute(pair.left.view(), pair.right.view());
  for (int frame = 0; frame < 2; ++frame) {
    const test::StepMaps maps = test::maps_after_steps(many, pair.left, pair.right);
    ASSERT_EQ(expected.size(), maps.size());
    for (std::size_t i = 0; i < maps.size(); ++i) {
      EXPECT_TRUE(same_image(expected[i].second, maps[i].second)) << "after " << maps[i].first;
    }
    EXPECT_TRUE(same_image(copy_of(result.confidence),
                           many.compute(pair.left.view(), pair.right.view()).confidence));
  }
}

// Feature: own threads, with the same result for any number
TEST(MatcherThreads, HaveTheSameResultForAnyNumber) {
  const Pair pair = test::slanted_pair(211, 139, 40, 1);
  for (const int threads : {0, 2, 3, 4, 7}) {
    expect_same_as_one_thread(pair, test::parameters({}), threads);
    expect_same_as_one_thread(
        pair,
        test::parameters({{"mode", "sparse"}, {"cost-volume", "full"}, {"max-disparity", "30"}}),
        threads);
    expect_same_as_one_thread(pair, test::parameters({{"mode", "dense"}, {"min-confidence", "60"}}),
                              threads);
    for (const char* const preset : {"default", "fast"}) {
      expect_same_as_one_thread(pair, test::parameters({{"preset", preset}, {"mode", "full"}}),
                                threads);
    }
    for (const char* const preset : {"fast", "paper"}) {
      expect_same_as_one_thread(pair, test::parameters({{"preset", preset}}), threads);
    }
  }
}

TEST(MatcherThreads, HaveTheSameResultInAStream) {
  const std::vector<Pair> frames = test::moving_frames(4, 211, 139);
  for (const char* const temporal : {"hold", "filter"}) {
    for (const int threads : {2, 3, 7}) {
      const auto matcher = [&](int count) {
        return test::matcher({{"temporal", temporal}, {"threads", std::to_string(count)}});
      };
      Matcher one = matcher(1), many = matcher(threads);
      for (const Pair& pair : frames) {
        EXPECT_TRUE(same_image(test::compute(one, pair.left, pair.right),
                               test::compute(many, pair.left, pair.right)))
            << temporal << ", " << threads << " threads";
      }
    }
  }
}

TEST(MatcherThreads, HaveTheSameResultAtTheBordersOfBands) {
  for (const int height : {31, 32, 33, 63, 64, 65, 97}) {
    expect_same_as_one_thread(test::slanted_pair(120, height, 20, height), test::parameters({}), 3);
  }
}

TEST(MatcherThreads, MayBeMoreThanRows) {
  expect_same_as_one_thread(test::slanted_pair(120, 5, 10, 3),
                            test::parameters({{"speckle-size", "0"}}), 16);
}

TEST(MatcherThreads, MayChangeFromFrameToFrame) {
  const Pair pair = test::slanted_pair(160, 90, 30, 4);
  Matcher matcher = test::matcher({{"threads", "1"}});
  const DisparityPlane expected = test::compute(matcher, pair.left, pair.right);
  for (const char* const threads : {"2", "1", "7", "3", "3", "0"}) {
    ASSERT_TRUE(matcher.set_parameters(test::parameters({{"threads", threads}})).ok());
    EXPECT_TRUE(same_image(expected, test::compute(matcher, pair.left, pair.right))) << threads;
  }
}

// Feature: several elements in one process
TEST(MatcherThreads, ConcurrentMatchersDoNotAffectEachOther) {
  struct Worker {
    Pair pair;
    Parameters parameters;
    DisparityPlane expected;
    int wrong = 0;
  };
  std::vector<Worker> workers = {
      {test::slanted_pair(170, 80, 30, 5), test::parameters({{"threads", "2"}}), {}},
      {test::slanted_pair(130, 120, 20, 6),
       test::parameters({{"threads", "2"}, {"mode", "sparse"}, {"cost-volume", "full"}}),
       {}},
      {test::slanted_pair(90, 60, 20, 7), test::parameters({{"threads", "1"}}), {}}};
  for (Worker& worker : workers) {
    Matcher matcher = std::move(Matcher::create(worker.parameters).value());
    worker.expected = test::compute(matcher, worker.pair.left, worker.pair.right);
    EXPECT_GT(test::known(worker.expected), 0);
  }
  std::vector<std::thread> threads;
  for (Worker& worker : workers) {
    threads.emplace_back([&worker] {
      Matcher matcher = std::move(Matcher::create(worker.parameters).value());
      for (int frame = 0; frame < 10; ++frame) {
        const auto result = matcher.compute(worker.pair.left.view(), worker.pair.right.view());
        if (!result.ok() || !(copy_of(result->disparity) == worker.expected)) ++worker.wrong;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const Worker& worker : workers) EXPECT_EQ(0, worker.wrong);
}

TEST(MatcherThreads, AMatcherCanBeUsedFromDifferentThreads) {
  const Pair pair = test::slanted_pair(120, 60, 20, 8);
  Matcher matcher = test::matcher({{"threads", "2"}});
  const DisparityPlane expected = test::compute(matcher, pair.left, pair.right);
  for (int n = 0; n < 5; ++n) {
    DisparityPlane map;
    std::thread([&] { map = test::compute(matcher, pair.left, pair.right); }).join();
    EXPECT_TRUE(same_image(expected, map));
  }
}

}  // namespace
}  // namespace mtstereo::matcher_threads_test
