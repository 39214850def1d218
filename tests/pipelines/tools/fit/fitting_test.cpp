// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/fit/fitting.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "stages/refine/reliability.hpp"
#include "tools/eval/degradation.hpp"

namespace mtstereo::fit::fitting_test {
namespace {

/// Samples whose odds depend on two clues, by the sum of known entries. In soft views the second
/// clue says less.
PairSamples made_samples(int count, unsigned seed, float soft = 0) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  PairSamples made{"made", eval::kCleanKind, {1, soft, 0, 0}, {}};
  for (int i = 0; i < count; ++i) {
    Sample sample{{}, true, false};
    sample.bins[kSupportClue] = static_cast<std::uint8_t>(random() % 4);
    sample.bins[kShareClue] = static_cast<std::uint8_t>(random() % 3);
    const double odds =
        1.5 * sample.bins[kSupportClue] - (1 - 0.8 * soft) * sample.bins[kShareClue];
    sample.wrong = uniform(random) > 1 / (1 + std::exp(-odds));
    made.samples.push_back(sample);
  }
  return made;
}

TEST(Fitting, FindsTheEntriesThatMadeTheSamples) {
  const PairSamples samples = made_samples(60000, 1);
  const LogOdds odds = fit({&samples});
  const auto& support = odds[kAnyPart][kSupportClue];
  const auto& share = odds[kAnyPart][kShareClue];
  for (int bin = 1; bin < 4; ++bin) EXPECT_NEAR(support[bin] - support[0], 1.5 * bin, 0.2);
  for (int bin = 1; bin < 3; ++bin) EXPECT_NEAR(share[bin] - share[0], -1.0 * bin, 0.1);
}

TEST(Fitting, FindsWhatSoftViewsAdd) {
  const PairSamples sharp = made_samples(60000, 4);
  const PairSamples soft = made_samples(60000, 5, 1), half = made_samples(60000, 6, 0.5F);
  const LogOdds odds = fit({&sharp, &soft, &half});
  const auto& usual = odds[kAnyPart][kShareClue];
  const auto& added = odds[kSoftPart][kShareClue];
  for (int bin = 1; bin < 3; ++bin) {
    const double in_sharp = usual[bin] - usual[0];
    EXPECT_NEAR(in_sharp, -1.0 * bin, 0.2);
    EXPECT_NEAR(in_sharp + added[bin] - added[0], -0.2 * bin, 0.2);
  }
  EXPECT_EQ(odds[kNoisyPart][kShareClue], LogOdds{}[kNoisyPart][kShareClue]);
}

TEST(Fitting, IgnoresSamplesWithoutTruth) {
  PairSamples samples = made_samples(5000, 2);
  const LogOdds before = fit({&samples});
  for (int i = 0; i < 5000; ++i) samples.samples.push_back({{}, false, true});
  EXPECT_EQ(before, fit({&samples}));
}

TEST(Fitting, GivesTheConfidenceOfTheOdds) {
  const PairSamples sharp = made_samples(60000, 3);
  const PairSamples samples = made_samples(60000, 7, 0.7F);
  const LogOdds odds = fit({&sharp, &samples});
  const ReliabilityTable table = table_for(library_table(odds), samples.shares);
  for (int i = 0; i < 100; ++i) {
    const Sample& sample = samples.samples[i];
    const double expected = kEvenOdds + kPerLogOdds * log_odds(odds, samples.shares, sample);
    EXPECT_NEAR(confidence(table, sample), std::clamp(expected, 1.0, 255.0), 1);
  }
}

TEST(Fitting, CountsWhatIsKept) {
  PairSamples samples{"made", eval::kCleanKind, {1, 0, 0, 0}, {}};
  // One right and one wrong answer of high confidence, two wrong ones of low confidence.
  for (const auto& [bin, wrong] : {std::pair{1, false}, {1, true}, {0, true}, {0, true}}) {
    Sample sample{{}, true, wrong};
    sample.bins[kSupportClue] = static_cast<std::uint8_t>(bin);
    samples.samples.push_back(sample);
  }
  TableParts table{};
  table[kAnyPart][kSupportClue][1] = 100 * kReliabilityOne;
  const Outcome kept = outcome({&samples}, {&table}, 50);
  EXPECT_DOUBLE_EQ(kept.density, 50);
  EXPECT_DOUBLE_EQ(kept.d_all, 50);
  EXPECT_DOUBLE_EQ(outcome({&samples}, {&table}, 1).d_all, 75);
}

const TableParts& guide_table() { return kReliabilityTables[static_cast<int>(RatedMap::kGuide)]; }

TEST(Samples, DependOnTheArgumentsOnly) {
  const std::vector<TrainingPair> pairs = rendered_pairs();
  ASSERT_FALSE(pairs.empty());
  for (const RatedMap rated : {RatedMap::kComplete, RatedMap::kHalfComplete, RatedMap::kMatched,
                               RatedMap::kHalfMatched, RatedMap::kGuide}) {
    const PairSamples first = take_samples(pairs[0], "noise=5", rated, guide_table(), 300);
    const PairSamples second = take_samples(pairs[0], "noise=5", rated, guide_table(), 300);
    const bool all = rated != RatedMap::kMatched && rated != RatedMap::kHalfMatched;
    ASSERT_EQ(first.samples.size(), second.samples.size());
    EXPECT_LE(first.samples.size(), all ? 300 : 299);
    EXPECT_GE(first.samples.size(), all ? 300 : 150);
    int wrong = 0;
    for (std::size_t i = 0; i < first.samples.size(); ++i) {
      EXPECT_EQ(first.samples[i].bins, second.samples[i].bins);
      wrong += first.samples[i].wrong;
    }
    EXPECT_LT(wrong, all ? 100 : 30);  // of a map that is mostly right
  }
}

TEST(Samples, OfEnlargedViewsAreWrongByPixelsOfTheOriginal) {
  const std::vector<TrainingPair> pairs = rendered_pairs();
  ASSERT_FALSE(pairs.empty());
  const auto share_of_wrong = [&](const char* kind) {
    const PairSamples taken =
        take_samples(pairs[0], kind, RatedMap::kComplete, guide_table(), 2000);
    int known = 0, wrong = 0;
    for (const Sample& sample : taken.samples) {
      known += sample.known;
      wrong += sample.wrong;
    }
    EXPECT_EQ(taken.kind, kind);
    EXPECT_GT(known, 1000) << kind;
    return static_cast<double>(wrong) / known;
  };
  // Twice as many pixels of the enlarged map would be 3 of its px away.
  EXPECT_NEAR(share_of_wrong("soft2x"), share_of_wrong(eval::kCleanKind), 0.02);
}

}  // namespace
}  // namespace mtstereo::fit::fitting_test
