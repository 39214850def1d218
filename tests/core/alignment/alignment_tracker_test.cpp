// SPDX-License-Identifier: LGPL-2.1-or-later
// The public class, with images; correction_policy_test.cpp has the rules.
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "mtstereo/mtstereo.hpp"
#include "support/field_pair.hpp"
#include "support/matching.hpp"

namespace mtstereo::alignment_tracker_test {
namespace {

using test::fails_with;
using test::FieldPair;
using test::Pair;

AlignmentTracker tracker() { return std::move(AlignmentTracker::create().value()); }

void inspect(AlignmentTracker& tracker, const Pair& pair) {
  const Status status = tracker.inspect(pair.left.view(), pair.right.view(), 64);
  EXPECT_TRUE(status.ok()) << (status.ok() ? "" : status.error().message);
}

FieldPair misaligned() {
  FieldPair options;
  options.field = {3.5, 0.9, 0, 0, 0};
  return options;
}

void expect_fresh(const AlignmentTracker& tracker) {
  EXPECT_EQ(FieldStatus::kNotInspected, tracker.findings().status);
  EXPECT_EQ(ViewCorrection(), tracker.correction());
  EXPECT_FALSE(tracker.trusted());
  EXPECT_EQ(0, tracker.views());
  for (int i = 0; i < kPairProblems; ++i) {
    const auto problem = static_cast<PairProblem>(i);
    EXPECT_FALSE(tracker.has(problem)) << problem_name(problem);
  }
}

TEST(AlignmentTracker, HasSeenNothingAtFirst) { expect_fresh(tracker()); }

TEST(AlignmentTracker, ForgetsAllProblemsOnReset) {
  const Pair pair = test::taken_as(misaligned());
  AlignmentTracker alignment = tracker();
  for (int i = 0; i < 12; ++i) {
    ASSERT_TRUE(alignment.watch(test::noise(320, 200, i).view(), pair.right.view()).ok());
  }
  EXPECT_TRUE(alignment.has(PairProblem::kRightFrozen));
  alignment.reset();
  expect_fresh(alignment);
  inspect(alignment, {pair.right, pair.left});
  EXPECT_TRUE(alignment.has(PairProblem::kSwapped));
  alignment.reset();
  expect_fresh(alignment);
  for (int i = 0; i < 3; ++i) inspect(alignment, {pair.left, test::texture(320, 200, i)});
  EXPECT_TRUE(alignment.has(PairProblem::kNotAPair));
  alignment.reset();
  expect_fresh(alignment);
}

TEST(AlignmentTracker, CorrectionMakesASinglePairMatchAsIfItWereAligned) {
  FieldPair options = misaligned();
  const Pair pair = test::taken_as(options);
  options.field = {};
  const Pair aligned = test::taken_as(options);
  AlignmentTracker alignment = tracker();
  inspect(alignment, pair);
  EXPECT_TRUE(alignment.trusted());
  Matcher matcher = test::matcher({{"max-disparity", "40"}});
  const long wanted = test::known(test::compute(matcher, aligned.left, aligned.right));
  const long without = test::known(test::compute(matcher, pair.left, pair.right));
  ASSERT_TRUE(matcher.set_correction(alignment.correction()).ok());
  const long corrected = test::known(test::compute(matcher, pair.left, pair.right));
  EXPECT_LT(without, wanted / 2);
  EXPECT_GT(corrected, wanted * 9 / 10);
}

TEST(AlignmentTracker, RestoresAField) {
  AlignmentTracker alignment = tracker();
  const RowField field = {0.5, -0.3, 0, 0, 0};
  ASSERT_TRUE(alignment.restore(field).ok());
  EXPECT_EQ(field, alignment.correction().rows);
  EXPECT_TRUE(alignment.trusted());
  EXPECT_TRUE(fails_with(alignment.restore({101, 0, 0, 0, 0}), ErrorCode::kInvalidParameter,
                         {"101", "range"}));
  EXPECT_EQ(field, alignment.correction().rows) << "changed by a field that was refused";
  alignment.reset();
  EXPECT_EQ(ViewCorrection(), alignment.correction());
}

TEST(AlignmentTracker, ReportsSwappedAndUnrelatedViews) {
  const Pair pair = test::taken_as(misaligned());
  AlignmentTracker alignment = tracker();
  inspect(alignment, {pair.right, pair.left});
  EXPECT_TRUE(alignment.has(PairProblem::kSwapped));
  EXPECT_EQ(ViewCorrection(), alignment.correction());
  alignment.reset();
  for (int i = 0; i < 3; ++i) inspect(alignment, {pair.left, test::texture(320, 200, i)});
  EXPECT_TRUE(alignment.has(PairProblem::kNotAPair));
  EXPECT_EQ(ViewCorrection(), alignment.correction());
  inspect(alignment, pair);
  EXPECT_FALSE(alignment.has(PairProblem::kNotAPair));
}

TEST(AlignmentTracker, DoesNotTakeViewsThatAreNotRectifiedForSwappedOnes) {
  // All disparities are negative, and rows differ by 6 px over the image: cameras that converge.
  FieldPair options;
  options.field = {1, 3, 0, 1.5, 0};
  const Pair pair = test::taken_as(options);
  AlignmentTracker alignment = tracker();
  for (int i = 0; i < 3; ++i) inspect(alignment, {pair.right, pair.left});
  EXPECT_GT(alignment.findings().negative_share, 0.5);
  EXPECT_NE(alignment.findings().status, FieldStatus::kSwapped);
  EXPECT_FALSE(alignment.has(PairProblem::kSwapped));
  EXPECT_EQ(ViewCorrection(), alignment.correction());
}

TEST(AlignmentTracker, ReportsViewsOutOfStepAndNotThatTheyAreSwapped) {
  FieldPair options;
  options.field = {1, 3, 0, 1.5, 0};
  const Pair scattered = test::taken_as(options), pair = test::taken_as(misaligned());
  AlignmentTracker alignment = tracker();
  for (int i = 0; i < 3; ++i) inspect(alignment, {scattered.right, scattered.left});
  EXPECT_TRUE(alignment.has(PairProblem::kOutOfStep));
  inspect(alignment, {pair.right, pair.left});
  EXPECT_EQ(alignment.findings().status, FieldStatus::kSwapped);
  EXPECT_TRUE(alignment.has(PairProblem::kOutOfStep));
  EXPECT_FALSE(alignment.has(PairProblem::kSwapped));
}

TEST(AlignmentTracker, ReportsBlankAndFrozenViews) {
  const Pair pair = test::taken_as({});
  AlignmentTracker alignment = tracker();
  const GrayPlane black(320, 200, 0);
  ASSERT_TRUE(alignment.watch(black.view(), pair.right.view()).ok());
  EXPECT_TRUE(alignment.has(PairProblem::kLeftBlank));
  EXPECT_FALSE(alignment.has(PairProblem::kRightBlank));
  for (int i = 0; i < 12; ++i) {
    ASSERT_TRUE(alignment.watch(test::noise(320, 200, i).view(), pair.right.view()).ok());
  }
  EXPECT_TRUE(alignment.has(PairProblem::kRightFrozen));
  EXPECT_FALSE(alignment.has(PairProblem::kLeftFrozen) || alignment.has(PairProblem::kLeftBlank));
}

TEST(AlignmentTracker, ReportsTheCauseAndNotItsConsequences) {
  AlignmentTracker alignment = tracker();
  for (int i = 0; i < 12; ++i) {
    const GrayPlane left = test::texture(320, 200, 10 + i), right = test::texture(320, 200, 1);
    ASSERT_TRUE(alignment.watch(left.view(), right.view()).ok());
    inspect(alignment, {left, right});
  }
  EXPECT_TRUE(alignment.has(PairProblem::kRightFrozen));
  EXPECT_FALSE(alignment.has(PairProblem::kNotAPair));
  const GrayPlane black(320, 200, 0);
  for (int i = 0; i < 12; ++i) {
    ASSERT_TRUE(alignment.watch(test::texture(320, 200, 40 + i).view(), black.view()).ok());
  }
  for (int i = 0; i < kPairProblems; ++i) {
    const auto problem = static_cast<PairProblem>(i);
    EXPECT_EQ(problem == PairProblem::kRightBlank, alignment.has(problem)) << problem_name(problem);
  }
}

TEST(AlignmentTracker, DependsOnThePairsOnly) {
  AlignmentTracker one = tracker(), other = tracker();
  inspect(other, test::taken_as({}));
  other.reset();
  for (int seed = 1; seed <= 4; ++seed) {
    FieldPair options = misaligned();
    options.seed = seed;
    options.noise = 3;
    const Pair pair = test::taken_as(options);
    inspect(one, pair);
    inspect(other, pair);
    EXPECT_EQ(one.correction(), other.correction());
    EXPECT_EQ(seed, one.views());
  }
}

TEST(AlignmentTracker, InvalidInputIsAnError) {
  const Pair pair = test::taken_as({});
  const GrayPlane small = test::texture(100, 100, 1);
  AlignmentTracker alignment = tracker();
  inspect(alignment, pair);
  const ViewCorrection before = alignment.correction();
  const auto left = pair.left.view();
  EXPECT_TRUE(
      fails_with(alignment.inspect(left, small.view(), 64), ErrorCode::kSizeMismatch, {"320x200"}));
  EXPECT_TRUE(fails_with(alignment.inspect({}, left, 64), ErrorCode::kInvalidImage, {"left"}));
  EXPECT_TRUE(fails_with(alignment.watch(left, {}), ErrorCode::kInvalidImage, {"right"}));
  for (const int disparity : {0, -1, kLargestMaxDisparity + 1}) {
    EXPECT_TRUE(fails_with(alignment.inspect(left, left, disparity), ErrorCode::kInvalidParameter,
                           {"max-disparity", std::to_string(disparity)}));
  }
  EXPECT_EQ(before, alignment.correction());
  EXPECT_TRUE(alignment.inspect(left, left, kLargestMaxDisparity).ok());
}

TEST(AlignmentTracker, AcceptsViewsOfAnySize) {
  AlignmentTracker alignment = tracker();
  for (const auto& [width, height] : {std::pair(1, 1), std::pair(96, 64), std::pair(97, 301),
                                      std::pair(2000, 64), std::pair(640, 65)}) {
    const GrayPlane view = test::texture(width, height, 1);
    ASSERT_TRUE(alignment.watch(view.view(), view.view()).ok());
    ASSERT_TRUE(alignment.inspect(view.view(), view.view(), 64).ok());
    EXPECT_EQ(RowField(), alignment.correction().rows);
  }
}

TEST(AlignmentTracker, EveryStatusAndProblemHasItsText) {
  std::set<std::string> texts;
  for (int i = 0; i <= static_cast<int>(FieldStatus::kSwapped); ++i) {
    EXPECT_TRUE(texts.insert(field_status_text(static_cast<FieldStatus>(i))).second) << i;
  }
  for (int i = 0; i < kPairProblems; ++i) {
    EXPECT_TRUE(texts.insert(problem_name(static_cast<PairProblem>(i))).second) << i;
    EXPECT_TRUE(texts.insert(problem_text(static_cast<PairProblem>(i))).second) << i;
  }
  EXPECT_EQ(0u, texts.count(""));
}

}  // namespace
}  // namespace mtstereo::alignment_tracker_test
