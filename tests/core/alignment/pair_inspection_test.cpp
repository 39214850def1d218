// SPDX-License-Identifier: LGPL-2.1-or-later
// Whole inspections of pairs whose field is known exactly, and of pairs that must be refused.
#include "alignment/pair_inspection.hpp"

#include <gtest/gtest.h>

#include "alignment/row_field.hpp"
#include "support/field_pair.hpp"
#include "support/padded_image.hpp"
#include "support/simd_targets.hpp"

namespace mtstereo::pair_inspection_test {
namespace {

using test::FieldPair;
using test::Pair;

PairFindings inspect(const GrayPlane& left, const GrayPlane& right, int max_disparity = 64) {
  PairInspector inspector;
  inspector.inspect(left.view(), right.view(), max_disparity);
  return inspector.findings();
}

PairFindings inspect(const Pair& pair) { return inspect(pair.left, pair.right); }

/// Expects the field to be found, with at most this error [px rms].
void expect_field(const FieldPair& options, double tolerance) {
  const PairFindings findings = inspect(test::taken_as(options));
  ASSERT_EQ(FieldStatus::kTrusted, findings.status)
      << options.field.to_text() << ", " << findings.matches << " matches of "
      << findings.candidates;
  EXPECT_LT(rms_difference(options.field, findings.field, options.width, options.height), tolerance)
      << options.field.to_text() << " was found as " << findings.field.to_text();
  EXPECT_GT(findings.inlier_share, 0.9);
  EXPECT_EQ(0, findings.left_blur + findings.right_blur);
}

TEST(PairInspection, FindsExactFields) {
  constexpr RowField kFields[] = {{0, 0, 0, 0, 0},   {0.5, 0, 0, 0, 0},        {-3, 0, 0, 0, 0},
                                  {0, 0.8, 0, 0, 0}, {3, -1.4, 0, 0, 0},       {0, 0, 0.9, 0, 0},
                                  {0, 0, 0, 1.5, 0}, {-0.5, 0.4, 0.3, -1, 1.2}};
  for (const RowField& field : kFields) {
    FieldPair options;
    options.field = field;
    expect_field(options, 0.05);
  }
}

TEST(PairInspection, FindsFieldsInViewsOfOtherContrastAndWithNoise) {
  FieldPair options;
  options.field = {0.8, -0.6, 0, 0, 0};
  options.right_gain = 0.5;
  expect_field(options, 0.05);
  options.noise = 8;
  expect_field(options, 0.08);
}

TEST(PairInspection, FindsFieldsInReducedViews) {
  FieldPair options;
  options.width = 1000;
  options.height = 300;
  options.disparity = 30;
  options.field = {1, 2, 0, 4, 0};
  expect_field(options, 0.05);
}

TEST(PairInspection, CorrectsNothingInExactPairs) {
  for (const int noise : {0, 2, 8}) {
    for (int seed = 1; seed <= 6; ++seed) {
      FieldPair options;
      options.noise = noise;
      options.seed = seed;
      options.slant = 0.02 * seed;
      const PairFindings findings = inspect(test::taken_as(options));
      EXPECT_EQ(FieldStatus::kTrusted, findings.status);
      EXPECT_EQ(RowField(), findings.field) << "noise " << noise << ", seed " << seed;
      EXPECT_EQ(0, findings.terms);
      EXPECT_EQ(0, findings.left_blur + findings.right_blur);
    }
  }
}

TEST(PairInspection, CorrectsNothingIfBothViewsAreTheSame) {
  for (int seed = 1; seed <= 4; ++seed) {
    const GrayPlane view = test::texture(300, 180, seed);
    const PairFindings findings = inspect(view, view);
    EXPECT_EQ(FieldStatus::kTrusted, findings.status);
    EXPECT_EQ(RowField(), findings.field);
    EXPECT_EQ(0, findings.negative_share);
    EXPECT_NEAR(1, findings.sharpness_ratio, 1e-9);
  }
}

TEST(PairInspection, RecognizesSwappedViews) {
  FieldPair options;
  options.disparity = 30;
  const Pair pair = test::taken_as(options);
  const PairFindings findings = inspect(pair.right, pair.left);
  EXPECT_EQ(FieldStatus::kSwapped, findings.status);
  EXPECT_GT(findings.negative_share, 0.9);
  EXPECT_EQ(RowField(), findings.field);
}

TEST(PairInspection, DoesNotTakeNegativeDisparitiesOfTheCameraForSwappedViews) {
  FieldPair options;
  options.disparity = 30;
  const Pair pair = test::taken_as(options);
  PairInspector inspector;
  inspector.inspect(pair.right.view(), pair.left.view(), 20, -60);
  EXPECT_EQ(FieldStatus::kTrusted, inspector.findings().status);
  EXPECT_EQ(0, inspector.findings().negative_share);
  inspector.inspect(pair.right.view(), pair.left.view(), 64, -10);
  EXPECT_EQ(FieldStatus::kSwapped, inspector.findings().status);
}

GrayPlane turned(const GrayPlane& view, bool along_rows, bool along_columns) {
  GrayPlane out(view.width, view.height);
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      out(x, y) =
          view(along_rows ? view.width - 1 - x : x, along_columns ? view.height - 1 - y : y);
    }
  }
  return out;
}

TEST(PairInspection, RefusesUnrelatedAndTurnedViews) {
  const Pair pair = test::taken_as({});
  for (const GrayPlane& right :
       {turned(pair.right, true, false), turned(pair.right, false, true),
        turned(pair.right, true, true), test::texture(320, 200, 77), test::noise(320, 200, 5)}) {
    const PairFindings findings = inspect(pair.left, right);
    EXPECT_EQ(FieldStatus::kTooFewMatches, findings.status) << field_status_text(findings.status);
    EXPECT_EQ(RowField(), findings.field);
    EXPECT_LT(findings.inliers, 12);
    EXPECT_EQ(0, findings.sharpness_ratio);
  }
}

TEST(PairInspection, RefusesRepeatedPatterns) {
  for (const int size : {5, 8, 12, 16}) {
    for (const int noise : {0, 3}) {
      test::Random random(size);
      GrayPlane left(400, 260), right(400, 260);
      const auto check = [&](int x, int y) {
        return static_cast<std::uint8_t>(((x / size + y / size) % 2 == 0 ? 60 : 190) +
                                         random.between(-noise, noise));
      };
      for (int y = 0; y < 260; ++y) {
        for (int x = 0; x < 400; ++x) {
          left(x, y) = check(x, y);
          right(x, y) = check(x + 3, y + 1);
        }
      }
      EXPECT_EQ(FieldStatus::kRepeatedPattern, inspect(left, right, 100).status) << size;
    }
  }
}

TEST(PairInspection, RefusesViewsWithoutTexture) {
  const Pair pair = test::taken_as({});
  GrayPlane stripes(320, 200), noise(320, 200);
  test::Random random(1);
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 320; ++x) {
      stripes(x, y) = x / 7 % 2 == 0 ? 60 : 190;
      noise(x, y) = static_cast<std::uint8_t>(120 + random.between(-20, 20));
    }
  }
  EXPECT_EQ(FieldStatus::kTooFewCorners, inspect(stripes, stripes).status);
  EXPECT_EQ(FieldStatus::kTooFewCorners, inspect(GrayPlane(320, 200, 9), pair.right).status);
  EXPECT_EQ(FieldStatus::kTooFewMatches, inspect(pair.left, GrayPlane(320, 200, 9)).status);
  EXPECT_EQ(FieldStatus::kTooFewCorners, inspect(noise, pair.right).status);
}

TEST(PairInspection, RefusesAPatchOfTextureAndSmallImages) {
  Pair pair = test::taken_as({});
  for (GrayPlane* view : {&pair.left, &pair.right}) {
    for (int y = 0; y < 200; ++y) {
      for (int x = 0; x < 320; ++x) {
        if (x < 140 || x > 220 || y < 70 || y > 130) (*view)(x, y) = 128;
      }
    }
  }
  EXPECT_NE(FieldStatus::kTrusted, inspect(pair).status);
  EXPECT_EQ(FieldStatus::kImageTooSmall,
            inspect(test::texture(95, 100, 1), test::texture(95, 100, 1)).status);
  EXPECT_EQ(FieldStatus::kImageTooSmall,
            inspect(test::texture(100, 63, 1), test::texture(100, 63, 1)).status);
}

TEST(PairInspection, EvensOutSharpnessAndFindsTheFieldThen) {
  FieldPair options;
  options.width = 480;
  options.height = 320;
  options.field.offset = 0.7;
  Pair pair = test::taken_as(options);
  Image<std::uint8_t> blurred;
  blurred.resize(options.width, options.height);
  BlurScratch scratch;
  blur_rows(pair.right.view(), gaussian_kernel(1.5F), 0, options.height, scratch, blurred);
  pair.right = test::copy_of(blurred);
  const PairFindings findings = inspect(pair);
  EXPECT_EQ(FieldStatus::kTrusted, findings.status);
  EXPECT_NEAR(1.5, findings.left_blur, 0.15);
  EXPECT_EQ(0, findings.right_blur);
  EXPECT_LT(rms_difference(options.field, findings.field, 480, 320), 0.05);
}

TEST(PairInspection, IsTheSameForAnyStrideInstructionSetAndHistory) {
  FieldPair options;
  options.width = 321;
  options.height = 203;
  options.field = {0.8, 0.5, -0.4, 0, 0};
  options.noise = 3;
  const Pair pair = test::taken_as(options);
  const PairFindings expected = inspect(pair);
  const test::PaddedImage<std::uint8_t> left(pair.left, 11, 5), right(pair.right, 30, 1);
  PairInspector inspector;
  test::for_each_simd_target([&] {
    const Pair other = test::slanted_pair(500, 300, 40, 1);
    inspector.inspect(other.left.view(), other.right.view(), 30);
    inspector.inspect(left.view(), right.view(), 64);
    EXPECT_EQ(expected.field, inspector.findings().field);
    EXPECT_EQ(expected.matches, inspector.findings().matches);
    EXPECT_EQ(expected.residual, inspector.findings().residual);
    EXPECT_EQ(expected.sharpness_ratio, inspector.findings().sharpness_ratio);
  });
  EXPECT_TRUE(left.unchanged() && right.unchanged());
}

}  // namespace
}  // namespace mtstereo::pair_inspection_test
