// SPDX-License-Identifier: LGPL-2.1-or-later
#include "alignment/row_field.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "base/guard.hpp"

namespace mtstereo {
namespace {

/// The mean squares of u and v over an image; their means are zero, and so are those of uv and of
/// all other odd products.
struct Moments {
  double uu;    ///< of u u
  double vv;    ///< of v v
  double vvvv;  ///< of v v v v

  Moments(int width, int height) : uu(1.0 / 3) {
    const double ratio = static_cast<double>(height) / std::max(width, 1);
    vv = ratio * ratio / 3;
    vvvv = ratio * ratio * ratio * ratio / 5;
  }
};

Error invalid_text(std::string_view text) {
  return {
      ErrorCode::kInvalidParameter,
      "'" + std::string(text) +
          "' is no row field: it needs five numbers from -100 to 100, separated by commas, as in "
          "'0.5,-0.1,0,0,0'"};
}

}  // namespace

FieldFactors field_factors(double x, double y, int width, int height) {
  const double half = width / 2.0;
  const double u = (x - (width - 1) / 2.0) / half;
  const double v = (y - (height - 1) / 2.0) / half;
  return {1, u, v, u * v, v * v};
}

std::array<double, kFieldTerms> terms_of(const RowField& field) {
  return {field.offset, field.roll, field.stretch, field.product, field.square};
}

RowField field_of(const std::array<double, kFieldTerms>& terms) {
  return {terms[0], terms[1], terms[2], terms[3], terms[4]};
}

Status check_field(const RowField& field) {
  for (const double term : terms_of(field)) {
    if (std::abs(term) <= kLargestFieldTerm) continue;
    return Error{ErrorCode::kInvalidParameter, "a row field has a term of " + std::to_string(term) +
                                                   " px: the range is -100 to 100"};
  }
  return {};
}

double rms_difference(const RowField& a, const RowField& b, int width, int height) {
  const RowField difference = {a.offset - b.offset, a.roll - b.roll, a.stretch - b.stretch,
                               a.product - b.product, a.square - b.square};
  return difference.rms(width, height);
}

double RowField::displacement(double x, double y, int width, int height) const noexcept {
  const FieldFactors factors = field_factors(x, y, width, height);
  const auto terms = terms_of(*this);
  double sum = 0;
  for (int i = 0; i < kFieldTerms; ++i) sum += terms[i] * factors[i];
  return sum;
}

double RowField::rms(int width, int height) const noexcept {
  const Moments m(width, height);
  const double mean_square = offset * offset + 2 * offset * square * m.vv + roll * roll * m.uu +
                             stretch * stretch * m.vv + product * product * m.uu * m.vv +
                             square * square * m.vvvv;
  return std::sqrt(std::max(mean_square, 0.0));
}

double RowField::largest(int width, int height) const noexcept {
  double largest = 0;
  for_extreme_points(width, height, [&](double x, double y) {
    largest = std::max(largest, std::abs(displacement(x, y, width, height)));
  });
  return largest;
}

double RowField::roll_degrees(int width) const noexcept {
  return std::atan(roll / (width / 2.0)) * 180 / std::numbers::pi;
}

std::string RowField::to_text() const {
  std::string text;
  for (const double term : terms_of(*this)) {
    std::array<char, 32> digits{};  // the shortest text of a double has at most 24
    const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), term);
    if (!text.empty()) text += ',';
    text.append(digits.data(), end);
  }
  return text;
}

Result<RowField> RowField::parse(std::string_view text) noexcept {
  return guarded([&]() -> Result<RowField> {
    std::array<double, kFieldTerms> terms{};
    const char* at = text.data();
    const char* const end = at + text.size();
    for (int i = 0; i < kFieldTerms; ++i) {
      if (i > 0 && (at == end || *at++ != ',')) return invalid_text(text);
      const auto [next, error] = std::from_chars(at, end, terms[i]);
      if (error != std::errc() || !(std::abs(terms[i]) <= kLargestFieldTerm)) {
        return invalid_text(text);
      }
      at = next;
    }
    if (at != end) return invalid_text(text);
    return field_of(terms);
  });
}

}  // namespace mtstereo
