// SPDX-License-Identifier: LGPL-2.1-or-later
// Pairs by time stamps alone: streams whose frames have numbers, so that wrong pairs are counted.
#include "matcher/pairing/pair_finder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <deque>
#include <random>
#include <vector>

namespace mtstereo::plugin::pair_finder_test {
namespace {

constexpr Nanoseconds kMs = 1'000'000;
constexpr Nanoseconds kSecond = 1000 * kMs;
constexpr Nanoseconds kPeriod = 33'333'333;

struct Frame {
  int number;
  Nanoseconds time;
};
using Frames = std::vector<Frame>;

Frames steady(int count, Nanoseconds start = 0, Nanoseconds period = kPeriod) {
  Frames frames;
  for (int i = 0; i < count; ++i) frames.push_back({i, start + i * period});
  return frames;
}

struct Outcome {
  int pairs = 0;
  int wrong = 0;
  int wrong_before_doubt = 0;
  int dropped = 0;
  int wrong_times = 0;
  std::size_t most_waiting = 0;
  std::vector<PairDoubt> doubts;
};

/// One stream: what has not been delivered yet and what waits.
struct Source {
  Frames all;
  std::size_t next = 0;
  std::deque<Frame> queue;
  bool deliver() {
    if (next == all.size()) return false;
    queue.push_back(all[next++]);
    return true;
  }
  std::vector<Nanoseconds> times() const {
    std::vector<Nanoseconds> result;
    for (const Frame& frame : queue) result.push_back(frame.time);
    return result;
  }
};

struct Rules {
  Nanoseconds tolerance = kPeriod / 2;
  std::array<Nanoseconds, 2> periods{kPeriod, kPeriod};
  bool skipping = false;
};

class Run {
 public:
  Run(Frames left, Frames right, const Rules& rules = {}) : rules_(rules) {
    sources_[0].all = std::move(left);
    sources_[1].all = std::move(right);
  }

  Outcome operator()() {
    for (;;) {
      for (Source& source : sources_) {
        if (source.queue.empty()) source.deliver();
        outcome_.most_waiting = std::max(outcome_.most_waiting, source.queue.size());
        if (source.queue.empty()) return outcome_;
      }
      step();
      if (HasFatalFailure()) return outcome_;
    }
  }

 private:
  static bool HasFatalFailure() { return testing::Test::HasFatalFailure(); }

  void step() {
    std::array<std::vector<Nanoseconds>, 2> times{sources_[0].times(), sources_[1].times()};
    std::array<WaitingFrames, 2> waiting;
    for (std::size_t i = 0; i < 2; ++i) {
      waiting[i] = {times[i], rules_.periods[i], sources_[i].next == sources_[i].all.size(),
                    rules_.skipping};
    }
    const PairDecision step = finder_.next(waiting[0], waiting[1], rules_.tolerance);
    const PairDoubt doubt = finder_.new_doubt();
    if (doubt != PairDoubt::kNone) outcome_.doubts.push_back(doubt);
    Source& source = sources_[static_cast<std::size_t>(step.side)];
    switch (step.action) {
      case PairAction::kWait:
        ASSERT_TRUE(source.deliver()) << "waits for a stream that has ended";
        return;
      case PairAction::kDrop:
        ASSERT_LT(step.index, source.queue.size());
        if (step.wrong_time) {
          ++outcome_.wrong_times;
        } else {
          ASSERT_EQ(step.index, 0u);
          finder_.dropped(step.side, source.queue.front().time);
          ++outcome_.dropped;
        }
        source.queue.erase(source.queue.begin() + static_cast<std::ptrdiff_t>(step.index));
        return;
      case PairAction::kPair:
        take_pair();
    }
  }

  void take_pair() {
    const Frame left = sources_[0].queue.front();
    const Frame right = sources_[1].queue.front();
    ++outcome_.pairs;
    if (left.number != right.number) {
      ++outcome_.wrong;
      if (outcome_.doubts.empty()) ++outcome_.wrong_before_doubt;
    }
    finder_.paired(left.time, right.time);
    for (Source& source : sources_) source.queue.pop_front();
  }

  Rules rules_;
  std::array<Source, 2> sources_;
  PairFinder finder_;
  Outcome outcome_;
};

Outcome run(Frames left, Frames right, const Rules& rules = {}) {
  return Run(std::move(left), std::move(right), rules)();
}

Frames lossy(Frames frames, double share, unsigned seed) {
  std::mt19937 random(seed);
  std::bernoulli_distribution lost(share);
  std::erase_if(frames, [&](const Frame&) { return lost(random); });
  return frames;
}

Frames jittery(Frames frames, Nanoseconds largest, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<Nanoseconds> jitter(-largest, largest);
  for (Frame& frame : frames) frame.time += jitter(random);
  return frames;
}

int common(const Frames& left, const Frames& right) {
  int count = 0;
  for (const Frame& frame : left) {
    count += static_cast<int>(std::count_if(right.begin(), right.end(), [&](const Frame& other) {
      return other.number == frame.number;
    }));
  }
  return count;
}

TEST(PairFinder, PairsEqualTimesWithoutLookingAhead) {
  const Outcome outcome = run(steady(100), steady(100));
  EXPECT_EQ(outcome.pairs, 100);
  EXPECT_EQ(outcome.wrong + outcome.dropped, 0);
  EXPECT_EQ(outcome.most_waiting, 1u);
  EXPECT_TRUE(outcome.doubts.empty());
}

TEST(PairFinder, PairsASkewOfLessThanAFifthOfAFrameWithoutLookingAhead) {
  const Outcome outcome = run(steady(100), steady(100, 6 * kMs));
  EXPECT_EQ(outcome.pairs, 100);
  EXPECT_EQ(outcome.most_waiting, 1u);
  EXPECT_TRUE(outcome.doubts.empty());
}

// Feature: pairs by running time, with a tolerance
TEST(PairFinder, LosesOnlyThePairsOfLostFramesDespiteSkew) {
  for (const Nanoseconds tolerance : {kPeriod / 2, 20 * kMs, 30 * kMs}) {
    for (const Nanoseconds skew : {0 * kMs, 6 * kMs, 10 * kMs, 15 * kMs, -15 * kMs, -7 * kMs}) {
      for (unsigned seed = 0; seed < 20; ++seed) {
        const Frames left = lossy(steady(300), 0.1, seed);
        const Frames right = lossy(steady(300, skew), 0.1, seed + 100);
        const Outcome outcome = run(left, right, {tolerance});
        EXPECT_EQ(outcome.wrong, 0)
            << "skew " << skew << " tolerance " << tolerance << " seed " << seed;
        EXPECT_GE(outcome.pairs, common(left, right) - 1) << "skew " << skew << " seed " << seed;
        EXPECT_EQ(outcome.doubts.empty(), std::abs(skew) * 5 < kPeriod) << skew;
      }
    }
  }
}

TEST(PairFinder, PairsJitteryStreamsWithLoss) {
  for (const Nanoseconds jitter : {5 * kMs, 10 * kMs, 14 * kMs}) {
    for (unsigned seed = 0; seed < 20; ++seed) {
      const Frames left = lossy(steady(300), 0.1, seed);
      const Frames right = lossy(jittery(steady(300), jitter, seed + 50), 0.1, seed + 100);
      for (const Nanoseconds tolerance : {kPeriod / 2, 20 * kMs}) {
        const Outcome outcome = run(left, right, {tolerance});
        EXPECT_EQ(outcome.wrong, 0) << "jitter " << jitter << " seed " << seed;
        EXPECT_GE(outcome.pairs, common(left, right) * 92 / 100)
            << "jitter " << jitter << " seed " << seed;
      }
    }
  }
}

// Feature: pairs by running time, with a tolerance
TEST(PairFinder, WarnsBeforeTheFirstWrongPairIfTimesCannotTell) {
  for (const Nanoseconds skew : {25 * kMs, 50 * kMs, -20 * kMs, 17 * kMs}) {
    for (const Nanoseconds tolerance : {kPeriod / 2, 20 * kMs}) {
      const Outcome outcome = run(steady(300), steady(300, skew), {tolerance});
      EXPECT_FALSE(outcome.doubts.empty()) << skew;
      EXPECT_EQ(outcome.wrong_before_doubt, 0) << skew;
      EXPECT_GT(outcome.pairs, 290) << skew;
    }
  }
}

TEST(PairFinder, FollowsADriftUpToTheToleranceAndReportsTheSlip) {
  for (const double drift : {0.002, -0.002}) {
    Frames right = steady(900);
    for (Frame& frame : right) {
      frame.time += static_cast<Nanoseconds>(drift * static_cast<double>(frame.time));
    }
    const Outcome outcome = run(steady(900), right);
    EXPECT_EQ(outcome.wrong_before_doubt, 0);
    ASSERT_GE(outcome.doubts.size(), 2u);
    EXPECT_EQ(outcome.doubts[0], PairDoubt::kOffset);
    EXPECT_EQ(std::count(outcome.doubts.begin(), outcome.doubts.end(), PairDoubt::kSlip), 2)
        << "after half a frame, and after another one";
    EXPECT_GT(outcome.pairs, 880);
    // 2 ms/s reach half a frame after 8.3 s = 250 frames: the partner is the same until then.
    EXPECT_LE(outcome.wrong, 650);
  }
}

TEST(PairFinder, AWildTimeStampCostsOneFrame) {
  for (const Nanoseconds jump :
       {kFarthestTime, 3600 * kSecond, 3 * kSecond, 200 * kMs, -3 * kSecond, -200 * kMs}) {
    for (const int at : {0, 1, 50, 299}) {
      for (const int side : {0, 1}) {
        std::array<Frames, 2> streams{steady(300), steady(300)};
        Nanoseconds& time =
            streams[static_cast<std::size_t>(side)][static_cast<std::size_t>(at)].time;
        time = bounded(time + jump);
        const Outcome outcome = run(streams[0], streams[1]);
        EXPECT_EQ(outcome.wrong, 0) << jump << " at " << at;
        EXPECT_GE(outcome.pairs, at == 0 && jump < 0 ? 298 : 299)
            << jump << " at " << at << " side " << side;
      }
    }
  }
}

TEST(PairFinder, AcceptsTimesAtTheEndsOfTheRange) {
  std::mt19937 random(7);
  constexpr std::array kTimes = {-kFarthestTime, -kPeriod, Nanoseconds{0}, kPeriod, kFarthestTime};
  for (int repetition = 0; repetition < 300; ++repetition) {
    std::array<Frames, 2> streams{steady(60), steady(60)};
    for (Frames& frames : streams) {
      for (Frame& frame : frames) {
        if (random() % 3 == 0) frame.time = kTimes[random() % kTimes.size()];
      }
    }
    Rules rules;
    rules.tolerance = repetition % 2 == 0 ? kPeriod / 2 : 3600 * kSecond;
    if (repetition % 3 == 0) rules.periods = {kFarthestTime, 0};
    const Outcome outcome = run(streams[0], streams[1], rules);
    EXPECT_LE(2 * outcome.pairs + outcome.dropped + outcome.wrong_times, 120);
  }
}

TEST(PairFinder, ADuplicateCostsNothingElse) {
  Frames right = steady(100);
  right.insert(right.begin() + 40, right[40]);
  const Outcome outcome = run(steady(100), right);
  EXPECT_EQ(outcome.pairs, 100);
  EXPECT_EQ(outcome.wrong, 0);
  EXPECT_EQ(outcome.wrong_times, 1);
}

TEST(PairFinder, TimesThatBothStreamsRepeatCostNothing) {
  // A file whose muxer has lost the order of its frames.
  Frames frames = steady(30);
  for (std::size_t i = 2; i < 29; i += 4) {
    frames[i].time = frames[i - 1].time;
    frames[i + 1].time = frames[i - 1].time;
  }
  const Outcome outcome = run(frames, frames);
  EXPECT_EQ(outcome.pairs, 30);
  EXPECT_EQ(outcome.wrong, 0);
}

TEST(PairFinder, AClockThatIsResetOnBothSidesCostsNothing) {
  Frames frames = steady(100, 100 * kSecond);
  for (std::size_t i = 50; i < frames.size(); ++i) frames[i].time -= 99 * kSecond;
  const Outcome outcome = run(frames, frames);
  EXPECT_EQ(outcome.pairs, 100);
  EXPECT_EQ(outcome.wrong, 0);
}

TEST(PairFinder, PairsAStreamThatStartsLater) {
  Frames right = steady(100);
  right.erase(right.begin(), right.begin() + 30);
  const Outcome outcome = run(steady(100), right);
  EXPECT_EQ(outcome.pairs, 70);
  EXPECT_EQ(outcome.wrong, 0);
  EXPECT_EQ(outcome.dropped, 30);
}

TEST(PairFinder, PairsStreamsOfDifferentRatesAtTheLowerOne) {
  const Nanoseconds half = kPeriod / 2;
  Frames fast = steady(200, 0, half);
  Frames slow;
  for (int i = 0; i < 100; ++i) slow.push_back({2 * i, 2 * i * half});
  const Rules rules{half / 2, {kPeriod, half}};
  const Outcome outcome = run(slow, fast, rules);
  EXPECT_EQ(outcome.pairs, 100);
  EXPECT_EQ(outcome.wrong, 0);
}

TEST(PairFinder, PairsTheNearestFramesOfThirtyAndTwentyFivePerSecond) {
  const Outcome outcome =
      run(steady(300), steady(250, 0, 40 * kMs), {kPeriod / 2, {kPeriod, 40 * kMs}});
  EXPECT_EQ(outcome.pairs, 250);
}

// Feature: the streams may differ in framerate and other caps
TEST(PairFinder, MeasuresTheRateIfCapsHaveNone) {
  const Frames left = lossy(steady(300), 0.1, 1);
  const Frames right = lossy(steady(300, 12 * kMs), 0.1, 2);
  const Outcome outcome = run(left, right, {20 * kMs, {0, 0}});
  EXPECT_EQ(outcome.wrong, 0);
  EXPECT_GE(outcome.pairs, common(left, right) - 1);
}

TEST(PairFinder, IgnoresARateInTheCapsThatIsWrong) {
  // The caps say 30 frames per second, the cameras send 10 in the dark.
  const Frames left = steady(200, 0, 3 * kPeriod);
  const Frames right = steady(200, 14 * kMs, 3 * kPeriod);
  const Outcome outcome = run(left, right);
  EXPECT_EQ(outcome.pairs, 200);
  EXPECT_EQ(outcome.wrong, 0);
}

TEST(PairFinder, RecoversAfterAnOutage) {
  Frames right = steady(600, 15 * kMs);
  right.erase(right.begin() + 100, right.begin() + 400);
  const Outcome outcome = run(steady(600), right);
  EXPECT_EQ(outcome.wrong, 0);
  EXPECT_GE(outcome.pairs, 299);
}

TEST(PairFinder, ReportsMeanSpreadAndDrift) {
  PairFinder finder;
  std::mt19937 random(1);
  std::uniform_int_distribution<Nanoseconds> jitter(-2 * kMs, 2 * kMs);
  for (int i = 0; i < 1000; ++i) {
    const Nanoseconds time = i * kPeriod;
    const Nanoseconds right = time + time / 1000 + jitter(random);
    const WaitingFrames lefts{{&time, 1}, kPeriod, false};
    const WaitingFrames rights{{&right, 1}, kPeriod, false};
    if (finder.next(lefts, rights, 3 * kPeriod).action == PairAction::kPair)
      finder.paired(time, right);
  }
  const DifferenceStatistics statistics = finder.offset().line().statistics();
  EXPECT_NEAR(statistics.drift, 1e6, 1e5);
  EXPECT_NEAR(statistics.spread, 4e6 / std::sqrt(12.0), 2e5);
  EXPECT_NEAR(statistics.mean, 33.3e6, 1e6);
}

TEST(PairFinder, PairsNoNeighborsOfKeyFramesWithALargeTolerance) {
  // Every 12th frame is a key frame on the left, every 25th on the right: 24 and 25 are neighbors.
  const auto key_frames = [](int interval) {
    Frames frames;
    for (int i = 0; i <= 1200; i += interval) frames.push_back({i, i * kPeriod});
    return frames;
  };
  const Outcome outcome =
      run(key_frames(12), key_frames(25), {.tolerance = 100 * kMs, .skipping = true});
  EXPECT_EQ(outcome.wrong, 0);
  EXPECT_EQ(outcome.pairs, 5);  // 0, 300, 600, ...
}

}  // namespace
}  // namespace mtstereo::plugin::pair_finder_test
