// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/engine/inspection.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "matcher/engine/alignment.hpp"

namespace mtstereo::plugin::inspection_test {
namespace {

/// The numbers of the pairs that are inspected; `trusted` states the result of each inspection, the
/// last one holds for all others.
std::vector<int> inspected(int pairs, int interval, const std::vector<bool>& trusted) {
  InspectionSchedule schedule;
  std::vector<int> numbers;
  for (int i = 0; i < pairs; ++i) {
    if (!schedule.due(interval)) continue;
    const std::size_t index = std::min(numbers.size(), trusted.size() - 1);
    numbers.push_back(i);
    schedule.inspected(trusted[index]);
  }
  return numbers;
}

TEST(InspectionInterval, GrowsAsMatchingTakesLessTime) {
  const AlignmentSettings automatic;
  const auto interval = [&](Preset preset, int width, int height, int range) {
    return automatic.effective_interval(preset, width, height, range);
  };
  EXPECT_EQ(interval(Preset::kDefault, 1242, 375, 100), 30);
  EXPECT_EQ(interval(Preset::kFast, 1242, 375, 100), 85);
  EXPECT_EQ(interval(Preset::kFast, 1920, 1080, 128), 30);
  EXPECT_EQ(interval(Preset::kFast, 16384, 16384, 1024), 30);
  EXPECT_EQ(interval(Preset::kFast, 16, 16, 1), 600);
  AlignmentSettings set;
  set.interval = 7;
  EXPECT_EQ(set.effective_interval(Preset::kFast, 1242, 375, 100), 7);
}

TEST(InspectionSchedule, InspectsTheFirstPairAndThenOnePerInterval) {
  EXPECT_EQ(inspected(70, 30, {true}), (std::vector<int>{0, 30, 60}));
}

TEST(InspectionSchedule, InspectsEveryPairWithAnIntervalOfOne) {
  EXPECT_EQ(inspected(3, 1, {true}), (std::vector<int>{0, 1, 2}));
}

TEST(InspectionSchedule, TriesSuccessivePairsUntilOneIsTrusted) {
  EXPECT_EQ(inspected(40, 30, {false, false, true}), (std::vector<int>{0, 1, 2, 32}));
}

TEST(InspectionSchedule, GivesUpAfterSomeAttempts) {
  EXPECT_EQ(inspected(70, 30, {false}), (std::vector<int>{0, 1, 2, 3, 33, 63}));
}

TEST(InspectionSchedule, TriesAgainAtOnceWhenTrustIsLost) {
  EXPECT_EQ(inspected(66, 30, {true, false}), (std::vector<int>{0, 30, 31, 32, 33, 63}));
}

TEST(InspectionSchedule, StartsOver) {
  InspectionSchedule schedule;
  EXPECT_TRUE(schedule.due(30));
  schedule.inspected(true);
  EXPECT_FALSE(schedule.due(30));
  schedule.restart();
  EXPECT_TRUE(schedule.due(30));
}

constexpr std::uint32_t kOne = 1, kTwo = 2;

TEST(ProblemWarnings, AreDueOncePerProblem) {
  ProblemWarnings warnings;
  EXPECT_EQ(warnings.due(0, 1), 0u);
  EXPECT_EQ(warnings.due(kOne, 1), kOne);
  EXPECT_EQ(warnings.due(kOne, 1), 0u);
  EXPECT_EQ(warnings.due(kOne | kTwo, 1), kTwo);
  EXPECT_EQ(warnings.due(kOne | kTwo, 1), 0u);
}

TEST(ProblemWarnings, AreNotDueAgainAfterAShortAbsence) {
  ProblemWarnings warnings;
  EXPECT_EQ(warnings.due(kOne, 2), kOne);
  for (int i = 1; i < ProblemWarnings::kSettling * 2; ++i) EXPECT_EQ(warnings.due(0, 2), 0u);
  EXPECT_EQ(warnings.due(kOne, 2), 0u);
  for (int i = 1; i < ProblemWarnings::kSettling * 2; ++i) EXPECT_EQ(warnings.due(0, 2), 0u);
  EXPECT_EQ(warnings.due(kOne, 2), 0u) << "the absences must not be added";
}

TEST(ProblemWarnings, AreDueAgainAfterTheProblemDisappeared) {
  ProblemWarnings warnings;
  EXPECT_EQ(warnings.due(kOne, 2), kOne);
  for (int i = 0; i < ProblemWarnings::kSettling * 2; ++i) warnings.due(kTwo, 2);
  EXPECT_EQ(warnings.due(kOne | kTwo, 2), kOne);
}

}  // namespace
}  // namespace mtstereo::plugin::inspection_test
