// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>

#include "mtstereo/alignment.hpp"

namespace mtstereo {

/// Number of terms of a RowField.
inline constexpr int kFieldTerms = 5;

/// The factors of the terms of a RowField at one point, in the order of its members.
using FieldFactors = std::array<double, kFieldTerms>;

FieldFactors field_factors(double x, double y, int width, int height);

/// The terms of a field in the order of its members.
std::array<double, kFieldTerms> terms_of(const RowField& field);
RowField field_of(const std::array<double, kFieldTerms>& terms);

/// Fails with kInvalidParameter if a term is not a number between -kLargestFieldTerm and
/// kLargestFieldTerm.
Status check_field(const RowField& field);

/// The root mean square difference of two fields over an image of this size [px].
double rms_difference(const RowField& a, const RowField& b, int width, int height);

/// Calls body(x, y) for the points of an image of this size at which a field is extreme, or nearly:
/// 5x5 points from border to border.
template <typename Body>
void for_extreme_points(int width, int height, Body&& body) {
  constexpr int kPoints = 5;
  for (int j = 0; j < kPoints; ++j) {
    for (int i = 0; i < kPoints; ++i) {
      body((width - 1.0) * i / (kPoints - 1), (height - 1.0) * j / (kPoints - 1));
    }
  }
}

}  // namespace mtstereo
