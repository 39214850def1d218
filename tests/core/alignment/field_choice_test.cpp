// SPDX-License-Identifier: LGPL-2.1-or-later
#include "alignment/field_choice.hpp"

#include <gtest/gtest.h>

namespace mtstereo::field_choice_test {
namespace {

constexpr int kWidth = 640, kHeight = 400;

/// A good fit whose models have these capped chi-squares.
FieldFit good_fit(const std::array<double, 4>& chi_squares) {
  FieldFit fit;
  fit.inliers = 200;
  fit.occupied_cells = 12;
  fit.residual = 0.1;
  constexpr RowField kFields[] = {{}, {1, 0, 0, 0, 0}, {1, 2, 0, 0, 0}, {1, 2, 0, 3, 0}};
  for (std::size_t i = 0; i < fit.models.size(); ++i) {
    fit.models[i].terms = kModelTerms[i];
    fit.models[i].field = kFields[i];
    fit.models[i].chi_square = chi_squares[i];
    fit.models[i].deviation = 0.02 * kModelTerms[i];
  }
  return fit;
}

FieldChoice choose(const FieldFit& fit, int matches = 220, int repeated = 0, double floor = 0.1) {
  return choose_field(fit, matches, repeated, floor, kWidth, kHeight);
}

TEST(FieldChoice, TakesTheSmallestModelThatExplainsTheMatches) {
  EXPECT_EQ(0, choose(good_fit({249, 230, 210, 200})).model.terms);
  EXPECT_EQ(1, choose(good_fit({251, 243, 210, 200})).model.terms);
  EXPECT_EQ(3, choose(good_fit({900, 245, 231, 200})).model.terms);
  EXPECT_EQ(5, choose(good_fit({900, 900, 233, 200})).model.terms);
}

TEST(FieldChoice, LeavesOutTermsThatAreTooUncertain) {
  FieldFit fit = good_fit({900, 900, 290, 200});
  fit.models[3].deviation = 0.16;
  EXPECT_EQ(3, choose(fit).model.terms);
  fit.models[2].chi_square = 400;
  EXPECT_EQ(FieldStatus::kTooUncertain, choose(fit).status) << "the terms are needed";
  fit.models[1].deviation = fit.models[2].deviation = 0.16;
  EXPECT_EQ(FieldStatus::kTooUncertain, choose(fit).status);
}

TEST(FieldChoice, IgnoresSmallFields) {
  FieldFit fit = good_fit({900, 201, 200, 200});
  fit.models[1].field.offset = 0.09;
  EXPECT_EQ(0, choose(fit).model.terms);
  EXPECT_EQ(FieldStatus::kTrusted, choose(fit).status);
  EXPECT_EQ(RowField(), choose(fit).model.field);
  EXPECT_EQ(1, choose(fit, 220, 0, 0.07).model.terms);
}

/// The status after a change of a good fit.
template <typename Change>
FieldStatus status_after(Change&& change, int matches = 220, int repeated = 0) {
  FieldFit fit = good_fit({900, 900, 900, 200});
  change(fit);
  const FieldChoice choice = choose(fit, matches, repeated);
  EXPECT_EQ(choice.status == FieldStatus::kTrusted, !(choice.model.field == RowField()));
  return choice.status;
}

TEST(FieldChoice, NamesTheReasonWithoutTrust) {
  EXPECT_EQ(FieldStatus::kTrusted, status_after([](FieldFit&) {}));
  EXPECT_EQ(FieldStatus::kTooFewMatches, status_after([](FieldFit&) {}, 39));
  EXPECT_EQ(FieldStatus::kTooFewInliers, status_after([](FieldFit&) {}, 320));
  EXPECT_EQ(FieldStatus::kTooFewInliers, status_after([](FieldFit& f) { f.inliers = 39; }, 40));
  EXPECT_EQ(FieldStatus::kSwapped, status_after([](FieldFit& f) { f.negative_share = 0.6; }));
  EXPECT_EQ(FieldStatus::kTooScattered, status_after([](FieldFit& f) { f.residual = 0.46; }));
  EXPECT_EQ(FieldStatus::kTooConcentrated, status_after([](FieldFit& f) { f.occupied_cells = 4; }));
  EXPECT_EQ(FieldStatus::kRepeatedPattern, status_after([](FieldFit&) {}, 220, 60));
  EXPECT_EQ(FieldStatus::kRepeatedPattern, status_after([](FieldFit&) {}, 0, 20));
  EXPECT_EQ(FieldStatus::kTrusted, status_after([](FieldFit&) {}, 220, 50));
}

}  // namespace
}  // namespace mtstereo::field_choice_test
