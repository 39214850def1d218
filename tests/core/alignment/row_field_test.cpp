// SPDX-License-Identifier: LGPL-2.1-or-later
#include "alignment/row_field.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/matching.hpp"
#include "support/random.hpp"

namespace mtstereo::row_field_test {
namespace {

using test::fails_with;

TEST(RowField, DisplacementIsTheSumOfItsTerms) {
  const RowField field = {1, 2, 3, 4, 5};
  EXPECT_DOUBLE_EQ(1, field.displacement(99.5, 24.5, 200, 50));
  EXPECT_DOUBLE_EQ(1 + 2, field.displacement(199.5, 24.5, 200, 50));
  EXPECT_DOUBLE_EQ(1 - 2 + 3 * 0.25 - 4 * 0.25 + 5 * 0.0625,
                   field.displacement(-0.5, 49.5, 200, 50));
}

TEST(RowField, RmsAndLargestAreThoseOfAllPixels) {
  test::Random random(1);
  for (int i = 0; i < 20; ++i) {
    const auto term = [&] { return random.between(-500, 500) / 100.0; };
    const RowField field = {term(), term(), term(), term(), term()};
    constexpr int kWidth = 300, kHeight = 170;
    double squares = 0, largest = 0;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const double dy = field.displacement(x, y, kWidth, kHeight);
        squares += dy * dy;
        largest = std::max(largest, std::abs(dy));
      }
    }
    EXPECT_NEAR(std::sqrt(squares / (kWidth * kHeight)), field.rms(kWidth, kHeight), 0.01);
    EXPECT_NEAR(largest, field.largest(kWidth, kHeight), 0.02 * largest);
    EXPECT_DOUBLE_EQ(field.rms(kWidth, kHeight), rms_difference(field, {}, kWidth, kHeight));
  }
}

TEST(RowField, TextGivesTheSameValuesAgain) {
  test::Random random(2);
  for (int i = 0; i < 100; ++i) {
    const auto term = [&] {
      return (random.between(-10000, 10000) / 101.0) / random.between(1, 1000);
    };
    const RowField field = {term(), term(), term(), term(), term()};
    const Result<RowField> parsed = RowField::parse(field.to_text());
    ASSERT_TRUE(parsed.ok()) << field.to_text();
    EXPECT_EQ(field, *parsed);
  }
  EXPECT_EQ("0.5,-0.1,0,0,100", (RowField{0.5, -0.1, 0, 0, 100}).to_text());
}

TEST(RowField, RefusesTextThatIsNoField) {
  for (const char* const text :
       {"", "0", "1,2,3,4", "1,2,3,4,5,6", "1,2,3,4,5,", ",1,2,3,4", "1,2,3,4,x", "1 ,2,3,4,5",
        "1,2,3,4,nan", "1,2,3,4,inf", "1,2,3,4,101", "-101,0,0,0,0", "1,,3,4,5", "1,2,3,4,5 "}) {
    EXPECT_TRUE(fails_with(RowField::parse(text), ErrorCode::kInvalidParameter, {text, "five"}))
        << text;
  }
}

TEST(RowField, ChecksTheRangeOfItsTerms) {
  EXPECT_TRUE(check_field({100, -100, 0, 0, 0}).ok());
  EXPECT_FALSE(check_field({0, 0, 0, 0, 100.1}).ok());
  EXPECT_FALSE(check_field({0, std::numeric_limits<double>::quiet_NaN(), 0, 0, 0}).ok());
}

}  // namespace
}  // namespace mtstereo::row_field_test
