// SPDX-License-Identifier: LGPL-2.1-or-later
#include "alignment/correction_policy.hpp"

#include <gtest/gtest.h>

#include "alignment/row_field.hpp"
#include "support/random.hpp"

namespace mtstereo::correction_policy_test {
namespace {

constexpr int kWidth = 640, kHeight = 400;

constexpr RowField kField = {0.8, -0.5, 0.2, 0, 0};
constexpr RowField kOther = {-0.4, 0.3, 0, 0, 0};

/// The matches of a scene that follow a field, with errors that belong to the scene.
std::vector<Match> matches_of(const RowField& field, int scene, double error = 0.1) {
  test::Random random(scene);
  std::vector<Match> matches;
  for (int i = 0; i < 150; ++i) {
    const auto x = static_cast<float>((kWidth - 1) * random.share());
    const auto y = static_cast<float>((kHeight - 1) * random.share());
    const double noise = error * (random.share() + random.share() - 1) * 2;
    matches.push_back({x + 15, y, x,
                       static_cast<float>(field.displacement(x, y, kWidth, kHeight) + noise),
                       0.01F});
  }
  return matches;
}

/// What an inspection that is trusted finds.
PairFindings trusted(const RowField& field) {
  PairFindings findings;
  findings.status = FieldStatus::kTrusted;
  findings.candidates = 300;
  findings.matches = findings.inliers = 150;
  findings.inlier_share = 1;
  findings.field = field;
  findings.terms = 3;
  findings.sharpness_ratio = 1;
  return findings;
}

PairFindings refused(FieldStatus status, int matches, int inliers) {
  PairFindings findings;
  findings.status = status;
  findings.candidates = 300;
  findings.matches = matches;
  findings.inliers = inliers;
  findings.inlier_share = matches > 0 ? static_cast<double>(inliers) / matches : 0;
  return findings;
}

class CorrectionPolicyTest : public testing::Test {
 protected:
  void see(const RowField& field, int scene) {
    policy_.add(trusted(field), matches_of(field, scene), kWidth, kHeight);
  }
  void see(const PairFindings& findings) { policy_.add(findings, {}, kWidth, kHeight); }
  void expect_field(const RowField& field, double tolerance = 0.05) const {
    EXPECT_LT(rms_difference(field, policy_.correction().rows, kWidth, kHeight), tolerance)
        << policy_.correction().rows.to_text();
  }
  CorrectionPolicy policy_;
};

TEST_F(CorrectionPolicyTest, AppliesTheFirstEstimateAtOnce) {
  EXPECT_FALSE(policy_.trusted());
  see(kField, 1);
  EXPECT_TRUE(policy_.trusted());
  EXPECT_EQ(1, policy_.views());
  expect_field(kField);
}

TEST_F(CorrectionPolicyTest, RefinesByLaterViewsUpToALimit) {
  for (int scene = 1; scene <= 20; ++scene) see(kField, scene);
  EXPECT_EQ(kPooledViews, policy_.views());
  expect_field(kField, 0.03);
}

TEST_F(CorrectionPolicyTest, CountsViewsOfTheSameSceneOnce) {
  for (int i = 0; i < 6; ++i) see(kField, 1);
  EXPECT_EQ(1, policy_.views());
  see(kField, 2);
  EXPECT_EQ(2, policy_.views());
}

TEST_F(CorrectionPolicyTest, FollowsASlowDrift) {
  RowField field = kField;
  for (int i = 0; i < 40; ++i) {
    field.offset += 0.03;
    see(field, i);
    EXPECT_TRUE(policy_.trusted()) << i;
  }
  expect_field(field, 0.2);
}

TEST_F(CorrectionPolicyTest, WithdrawsAFieldThatTheNextEstimateContradicts) {
  see(kField, 1);
  see(kOther, 2);
  EXPECT_FALSE(policy_.trusted());
  EXPECT_EQ(RowField(), policy_.correction().rows);
  see(kOther, 3);
  EXPECT_EQ(RowField(), policy_.correction().rows) << "two estimates are not enough then";
  see(kOther, 4);
  EXPECT_TRUE(policy_.trusted());
  expect_field(kOther);
}

TEST_F(CorrectionPolicyTest, IgnoresOneContradictionOfAnEstablishedField) {
  for (int scene = 1; scene <= 4; ++scene) see(kField, scene);
  see(kOther, 5);
  EXPECT_TRUE(policy_.trusted());
  expect_field(kField);
  see(kField, 6);
  see(kOther, 7);
  EXPECT_TRUE(policy_.trusted());
  see(kOther, 8);
  EXPECT_FALSE(policy_.trusted()) << "two in succession";
}

TEST_F(CorrectionPolicyTest, NeverAppliesEstimatesThatKeepChanging) {
  see(kField, 1);
  for (int i = 0; i < 20; ++i) {
    see(i % 2 == 0 ? kOther : kField, i + 2);
    EXPECT_EQ(RowField(), policy_.correction().rows);
  }
  EXPECT_TRUE(policy_.out_of_step());
}

TEST_F(CorrectionPolicyTest, WithdrawsAYoungFieldIfLaterMatchesFitNoField) {
  see(kField, 1);
  see(refused(FieldStatus::kTooFewInliers, 100, 50));
  EXPECT_TRUE(policy_.trusted());
  see(refused(FieldStatus::kTooFewInliers, 100, 50));
  EXPECT_FALSE(policy_.trusted());
  EXPECT_EQ(RowField(), policy_.correction().rows);
}

TEST_F(CorrectionPolicyTest, KeepsTheFieldWhileNothingCanBeSeen) {
  see(kField, 1);
  for (int i = 0; i < 20; ++i) see(refused(FieldStatus::kTooFewMatches, 3, 0));
  EXPECT_TRUE(policy_.trusted());
  expect_field(kField);
  EXPECT_FALSE(policy_.out_of_step());
}

TEST_F(CorrectionPolicyTest, LeavesSmallFieldsAlone) {
  for (int scene = 1; scene <= 8; ++scene) see({0.08, 0, 0, 0, 0}, scene);
  EXPECT_TRUE(policy_.trusted());
  EXPECT_EQ(RowField(), policy_.correction().rows);
}

TEST_F(CorrectionPolicyTest, KeepsARestoredFieldUntilEstimatesAgreeOnAnother) {
  policy_.restore(kField);
  EXPECT_TRUE(policy_.trusted());
  EXPECT_EQ(kField, policy_.correction().rows);
  see(kOther, 1);
  see(kOther, 2);
  EXPECT_EQ(kField, policy_.correction().rows);
  see(kOther, 3);
  expect_field(kOther);
}

TEST_F(CorrectionPolicyTest, KeepsARestoredFieldWhenEstimatesDisagree) {
  policy_.restore(kField);
  for (int i = 0; i < 10; ++i) {
    see(i % 2 == 0 ? kOther : RowField{1.5, 0, 0, 0, 0}, i + 1);
    EXPECT_EQ(kField, policy_.correction().rows);
  }
}

TEST_F(CorrectionPolicyTest, ReportsSwappedViewsWhileTheyAre) {
  see(refused(FieldStatus::kSwapped, 100, 95));
  EXPECT_TRUE(policy_.swapped());
  see(refused(FieldStatus::kTooFewMatches, 3, 0));
  EXPECT_TRUE(policy_.swapped());
  see(kField, 1);
  EXPECT_FALSE(policy_.swapped());
}

TEST_F(CorrectionPolicyTest, ReportsUnrelatedViewsAfterSomeInspections) {
  for (int i = 0; i < kNeededNotAPair; ++i) {
    EXPECT_FALSE(policy_.not_a_pair());
    see(refused(FieldStatus::kTooFewMatches, 4, 1));
  }
  EXPECT_TRUE(policy_.not_a_pair());
  see(kField, 1);
  EXPECT_FALSE(policy_.not_a_pair());
}

TEST_F(CorrectionPolicyTest, DoesNotReportDarkViewsAsUnrelated) {
  for (int i = 0; i < 10; ++i) see(refused(FieldStatus::kTooFewMatches, 8, 8));
  EXPECT_FALSE(policy_.not_a_pair());
  PairFindings flat = refused(FieldStatus::kTooFewCorners, 0, 0);
  flat.candidates = 20;
  for (int i = 0; i < 10; ++i) see(flat);
  EXPECT_FALSE(policy_.not_a_pair());
}

TEST_F(CorrectionPolicyTest, ReportsViewsThatAreOutOfStep) {
  for (int i = 0; i < kNeededOutOfStep; ++i) {
    EXPECT_FALSE(policy_.out_of_step());
    see(refused(FieldStatus::kTooFewInliers, 100, 55));
  }
  EXPECT_TRUE(policy_.out_of_step());
  for (int i = 0; i < 4; ++i) see(kField, i + 1);
  EXPECT_FALSE(policy_.out_of_step());
}

TEST_F(CorrectionPolicyTest, TakesTheMedianOfTheSharpness) {
  PairFindings blurred = trusted({});
  blurred.sharpness_ratio = 1.6;
  blurred.left_blur = 1.1F;
  policy_.add(blurred, matches_of({}, 1), kWidth, kHeight);
  EXPECT_FLOAT_EQ(1.1F, policy_.correction().left_blur);
  EXPECT_TRUE(policy_.sharpness_differs());
  blurred.left_blur = 1.15F;
  policy_.add(blurred, matches_of({}, 2), kWidth, kHeight);
  EXPECT_FLOAT_EQ(1.1F, policy_.correction().left_blur) << "no small changes";
  see({}, 3);
  EXPECT_TRUE(policy_.sharpness_differs()) << "one of three";
  for (int scene = 4; scene < 9; ++scene) see({}, scene);
  EXPECT_FALSE(policy_.sharpness_differs());
  blurred.left_blur = 0;
  blurred.right_blur = 0.8F;
  for (int scene = 10; scene < 14; ++scene) {
    policy_.add(blurred, matches_of({}, scene), kWidth, kHeight);
  }
  EXPECT_FLOAT_EQ(0.8F, policy_.correction().right_blur);
  EXPECT_EQ(0, policy_.correction().left_blur);
  policy_.reset();
  see({}, 1);
  EXPECT_EQ(0, policy_.correction().right_blur) << "after a reset";
}

TEST_F(CorrectionPolicyTest, StartsAgainAfterResetAndAfterAChangeOfTheSize) {
  see(kField, 1);
  policy_.reset();
  EXPECT_FALSE(policy_.trusted());
  EXPECT_EQ(ViewCorrection(), policy_.correction());
  EXPECT_EQ(0, policy_.views());
  see(kField, 1);
  policy_.add(refused(FieldStatus::kTooFewMatches, 0, 0), {}, kWidth / 2, kHeight / 2);
  EXPECT_EQ(ViewCorrection(), policy_.correction());
}

}  // namespace
}  // namespace mtstereo::correction_policy_test
