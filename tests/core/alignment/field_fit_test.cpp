// SPDX-License-Identifier: LGPL-2.1-or-later
#include "alignment/field_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/random.hpp"

namespace mtstereo::field_fit_test {
namespace {

constexpr int kWidth = 640, kHeight = 400;

/// A number of about normal distribution and standard deviation 1.
double normal(test::Random& random) {
  double sum = -6;
  for (int i = 0; i < 12; ++i) sum += random.share();
  return sum;
}

/// Matches at random places: all follow the field, but for `wrong` of them.
std::vector<Match> matches_of(const RowField& field, int count, int wrong, double deviation,
                              std::uint64_t seed) {
  test::Random random(seed);
  std::vector<Match> matches;
  for (int i = 0; i < count; ++i) {
    const auto x = static_cast<float>(kWidth * random.share());
    const auto y = static_cast<float>(kHeight * random.share());
    const double exact = field.displacement(x, y, kWidth, kHeight) + deviation * normal(random);
    const double rows = i < wrong ? 16 * random.share() - 8 : exact;
    matches.push_back(
        {x + 20, y, x, static_cast<float>(rows), static_cast<float>(deviation * deviation)});
  }
  return matches;
}

FieldFit fit(const std::vector<Match>& matches) {
  FitScratch scratch;
  return fit_field(matches, kWidth, kHeight, scratch);
}

constexpr RowField kFields[] = {
    {0, 0, 0, 0, 0},     {1.5, 0, 0, 0, 0}, {-0.4, 2.5, 0, 0, 0},
    {3, 2.8, 1.6, 0, 0}, {0, 0, 0, 5, -1},  {-2, 1, 0.5, -3, 1.5},
};

TEST(FieldFit, RecoversFieldsFromExactMatches) {
  for (const RowField& field : kFields) {
    const FieldFit found = fit(matches_of(field, 200, 0, 0.001, 1));
    EXPECT_EQ(200, found.inliers);
    EXPECT_LT(rms_difference(field, found.full().field, kWidth, kHeight), 0.01) << field.to_text();
  }
}

TEST(FieldFit, RecoversFieldsFromNoisyMatchesWithOutliers) {
  for (const RowField& field : kFields) {
    for (int seed = 1; seed <= 5; ++seed) {
      const FieldFit found = fit(matches_of(field, 300, 90, 0.15, seed));
      EXPECT_LT(rms_difference(field, found.full().field, kWidth, kHeight), 0.06)
          << field.to_text();
      EXPECT_NEAR(0.15, found.residual, 0.06);
      EXPECT_GE(found.inliers, 205);
      EXPECT_LE(found.inliers, 240);
      EXPECT_EQ(12, found.occupied_cells);
    }
  }
}

TEST(FieldFit, PredictsTheErrorOfTheField) {
  double squares = 0, predicted = 0;
  constexpr int kFits = 40;
  for (int seed = 1; seed <= kFits; ++seed) {
    const FieldFit found = fit(matches_of({}, 150, 0, 0.2, seed));
    const double error = found.full().field.displacement(0, 0, kWidth, kHeight);
    squares += error * error / kFits;
    predicted += found.full().deviation / kFits;
  }
  EXPECT_GT(predicted, 0.6 * std::sqrt(squares));
  EXPECT_LT(predicted, 2.5 * std::sqrt(squares));
}

TEST(FieldFit, ModelsWithMoreTermsFitBetter) {
  const FieldFit found = fit(matches_of({0.3, 0.5, 0, 1, 0}, 300, 30, 0.1, 1));
  for (std::size_t i = 1; i < found.models.size(); ++i) {
    EXPECT_LT(found.models[i].chi_square, found.models[i - 1].chi_square);
    EXPECT_GT(found.models[i].deviation, found.models[i - 1].deviation);
    EXPECT_EQ(kModelTerms[i], found.models[i].terms);
  }
  EXPECT_EQ(RowField(), found.models[0].field);
  EXPECT_EQ(0, found.models[1].field.roll);
  EXPECT_EQ(0, found.models[2].field.product);
}

TEST(FieldFit, CountsNegativeDisparities) {
  std::vector<Match> matches = matches_of({}, 100, 0, 0.1, 1);
  for (int i = 0; i < 30; ++i) matches[i].x_left = matches[i].x_right - 2;
  EXPECT_NEAR(0.3, fit(matches).negative_share, 1e-9);
}

TEST(FieldFit, NeedsSomeMatchesAndSurvivesAnyOfThem) {
  EXPECT_EQ(0, fit({}).inliers);
  EXPECT_EQ(0, fit(matches_of({}, 5, 0, 0.1, 1)).inliers);
  const std::vector<Match> same(50, Match{100, 50, 90, 0.5F, 0.01F});
  const FieldFit found = fit(same);
  EXPECT_EQ(1, found.occupied_cells);
  EXPECT_TRUE(std::isfinite(found.full().field.offset));
  EXPECT_GT(found.full().deviation, 1);
}

TEST(FieldFit, GivesTheSameResultAgain) {
  const std::vector<Match> matches = matches_of(kFields[5], 250, 100, 0.2, 3);
  FitScratch scratch;
  const FieldFit first = fit_field(matches, kWidth, kHeight, scratch);
  fit_field(matches_of({}, 300, 0, 0.1, 9), kWidth, kHeight, scratch);
  const FieldFit again = fit_field(matches, kWidth, kHeight, scratch);
  EXPECT_EQ(first.full().field, again.full().field);
  EXPECT_EQ(first.full().chi_square, again.full().chi_square);
}

}  // namespace
}  // namespace mtstereo::field_fit_test
