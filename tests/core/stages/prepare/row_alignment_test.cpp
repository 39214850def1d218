// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/prepare/row_alignment.hpp"

#include <gtest/gtest.h>

#include "reference/prepare/row_alignment.hpp"
#include "support/compare.hpp"
#include "support/padded_image.hpp"
#include "support/random.hpp"
#include "support/simd_targets.hpp"

namespace mtstereo::row_alignment_test {
namespace {

GrayPlane aligned(GrayView view, const RowField& field, int band = 1 << 20) {
  Image<std::uint8_t> out = test::image_of(GrayPlane(view.width, view.height, 77));
  AlignmentScratch scratch;
  for (int y = 0; y < view.height; y += band) {
    align_rows(view, field, y, std::min(y + band, view.height), scratch, out);
  }
  return test::copy_of(out);
}

/// Expects all pixels to differ by at most `tolerance`.
void expect_close(const GrayPlane& expected, const GrayPlane& actual, int tolerance) {
  ASSERT_EQ(expected.pixels.size(), actual.pixels.size());
  int worst = 0;
  for (std::size_t i = 0; i < expected.pixels.size(); ++i) {
    worst = std::max(worst, std::abs(expected.pixels[i] - actual.pixels[i]));
  }
  EXPECT_LE(worst, tolerance);
}

RowField random_field(test::Random& random) {
  const auto term = [&](int largest) {
    return random.between(-100 * largest, 100 * largest) / 100.0;
  };
  return {term(6), term(3), term(3), term(3), term(3)};
}

TEST(RowAlignment, FollowsReferenceAtAnySizeStrideAndField) {
  test::Random random(1);
  for (int width = 1; width <= 90; ++width) {
    const int height = width % 7 == 0 ? 41 : width % 5 + 1;
    const GrayPlane view = test::noise(width, height, width);
    const RowField field = random_field(random);
    const test::PaddedImage<std::uint8_t> padded(view, width % 70, height % 5);
    const GrayPlane once = aligned(padded.view(), field);
    // The reference does not round between the two directions as the stage does.
    expect_close(reference::align(view, field), once, 2);
    for (const int band : {1, 7}) {
      EXPECT_TRUE(same_image(once, aligned(padded.view(), field, band)));
    }
    EXPECT_TRUE(padded.unchanged());
  }
}

TEST(RowAlignment, IsTheSameOnEveryInstructionSet) {
  const GrayPlane view = test::noise(203, 61, 5);
  test::Random random(2);
  for (int i = 0; i < 10; ++i) {
    const RowField field = random_field(random);
    GrayPlane expected;
    test::for_each_simd_target([&] {
      const GrayPlane out = aligned(view.view(), field);
      if (expected.width == 0) expected = out;
      EXPECT_TRUE(same_image(expected, out));
    });
  }
}

TEST(RowAlignment, FieldZeroKeepsEveryPixel) {
  const GrayPlane view = test::noise(101, 31, 1);
  EXPECT_TRUE(same_image(view, aligned(view.view(), {})));
}

TEST(RowAlignment, WholeOffsetMovesRows) {
  const GrayPlane view = test::noise(50, 40, 1);
  for (const int offset : {-3, 2, 100}) {
    GrayPlane expected(50, 40);
    for (int y = 0; y < 40; ++y) {
      for (int x = 0; x < 50; ++x) expected(x, y) = view.clamped(x, y + offset);
    }
    RowField field;
    field.offset = offset;
    EXPECT_TRUE(same_image(expected, aligned(view.view(), field)));
  }
}

TEST(RowAlignment, MovesSidewaysOnlyForLargeRollAndStretch) {
  constexpr int kWidth = 400, kHeight = 300;
  const double half = kWidth / 2.0;
  RowField field;
  field.roll = 0.99 * kSmallestRoll * half;
  field.stretch = 0.99 * kSmallestStretch * half;
  field.product = field.square = 3;
  EXPECT_FALSE(displacement_of_row(field, 0, kWidth, kHeight).moves_sideways());
  field.roll = -1.01 * kSmallestRoll * half;
  EXPECT_TRUE(displacement_of_row(field, 0, kWidth, kHeight).moves_sideways());
  field.roll = 0;
  field.stretch = 1.01 * kSmallestStretch * half;
  const RowDisplacement row = displacement_of_row(field, 77, kWidth, kHeight);
  EXPECT_NEAR(-field.stretch, row.shift + row.zoom * -0.5, 1e-9) << "at the left border";
  EXPECT_NEAR(0, row.shift + row.zoom * (kWidth - 1) / 2.0, 1e-9) << "at the center";
}

/// A smooth image, 0 .. 255.
double image_at(double x, double y) {
  return 127.5 + 60 * std::sin(x / 5 + y / 11) + 60 * std::cos(y / 4 - x / 9);
}

TEST(RowAlignment, UndoesARotation) {
  constexpr int kWidth = 320, kHeight = 200;
  const double angle = 0.008, cx = (kWidth - 1) / 2.0, cy = (kHeight - 1) / 2.0;
  GrayPlane straight(kWidth, kHeight), rolled(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      straight(x, y) = reference::gray(image_at(x, y));
      rolled(x, y) = reference::gray(image_at(x + angle * (y - cy), y - angle * (x - cx)));
    }
  }
  RowField field;
  field.roll = angle * kWidth / 2;
  const GrayPlane out = aligned(rolled.view(), field);
  int worst = 0;
  for (int y = 5; y < kHeight - 5; ++y) {
    for (int x = 5; x < kWidth - 5; ++x) {
      worst = std::max(worst, std::abs(straight(x, y) - out(x, y)));
    }
  }
  EXPECT_LE(worst, 4);
  EXPECT_NEAR(0.458, field.roll_degrees(kWidth), 0.001);
}

}  // namespace
}  // namespace mtstereo::row_alignment_test
