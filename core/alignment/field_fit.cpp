// SPDX-License-Identifier: LGPL-2.1-or-later
#include "alignment/field_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace mtstereo {
namespace {

using FieldTerms = Eigen::Matrix<double, kFieldTerms, 1>;
using FieldNormal = Eigen::Matrix<double, kFieldTerms, kFieldTerms>;

constexpr int kFewestMatches = 6;
constexpr int kSamples = 150;
/// Residuals that have a quarter of the weight in the first rounds of the fit [px]. The affine
/// field of the start may be wrong by this much where the other terms are large.
constexpr std::array<double, 5> kFirstScales = {3, 2.5, 2, 1.5, 1};
constexpr int kFitRounds = 14;
/// Expected sizes of the terms [px]: they keep a term near zero about which the matches say
/// nothing.
constexpr std::array<double, kFieldTerms> kPriorSigmas = {10, 10, 10, 2, 2};

/// The same numbers in every run.
class Sampler {
 public:
  int below(int count) {
    state_ = state_ * 6364136223846793005U + 1442695040888963407U;
    return static_cast<int>((state_ >> 33) % static_cast<std::uint64_t>(count));
  }

 private:
  std::uint64_t state_ = 1;
};

/// The terms of an affine field through three matches; false if they lie on a line.
bool through_three(std::span<const Match> matches, const std::vector<FieldFactors>& factors,
                   const std::array<int, 3>& chosen, Eigen::Vector3d& terms) {
  Eigen::Matrix3d system;
  Eigen::Vector3d rows;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) system(i, k) = factors[chosen[i]][k];
    rows[i] = matches[chosen[i]].rows;
  }
  // Cramer's rule: the determinant is twice the area of the triangle.
  const double area = system.determinant();
  constexpr double kSmallestArea = 0.01;
  if (std::abs(area) < kSmallestArea) return false;
  for (int k = 0; k < 3; ++k) {
    Eigen::Matrix3d replaced = system;
    replaced.col(k) = rows;
    terms[k] = replaced.determinant() / area;
  }
  return true;
}

/// The affine field with which most matches agree (RANSAC).
FieldTerms sample_consensus(std::span<const Match> matches,
                            const std::vector<FieldFactors>& factors) {
  const int count = static_cast<int>(matches.size());
  Sampler sampler;
  FieldTerms best = FieldTerms::Zero();
  int most = -1;
  for (int sample = 0; sample < kSamples; ++sample) {
    const std::array<int, 3> chosen = {sampler.below(count), sampler.below(count),
                                       sampler.below(count)};
    Eigen::Vector3d terms;
    if (!through_three(matches, factors, chosen, terms)) continue;
    int agree = 0;
    for (int i = 0; i < count; ++i) {
      const double field = terms[0] + terms[1] * factors[i][1] + terms[2] * factors[i][2];
      agree += std::abs(matches[i].rows - field) < kInlierLimit ? 1 : 0;
    }
    if (agree <= most) continue;
    most = agree;
    best << terms, 0, 0;
  }
  return best;
}

void find_residuals(std::span<const Match> matches, const FieldTerms& terms, FitScratch& scratch) {
  for (std::size_t i = 0; i < matches.size(); ++i) {
    double field = 0;
    for (int k = 0; k < kFieldTerms; ++k) field += terms[k] * scratch.factors[i][k];
    scratch.residuals[i] = matches[i].rows - field;
  }
}

/// The median of the values that `of(i)` returns for the inliers; 0 if there are none.
template <typename Of>
double median_of_inliers(FitScratch& scratch, Of&& of) {
  std::vector<double>& sorted = scratch.sorted;
  sorted.clear();
  for (std::size_t i = 0; i < scratch.residuals.size(); ++i) {
    if (std::abs(scratch.residuals[i]) < kInlierLimit) sorted.push_back(of(i));
  }
  if (sorted.empty()) return 0;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  return *middle;
}

double robust_deviation(FitScratch& scratch) {
  constexpr double kOfMedian = 1.4826;
  return kOfMedian *
         median_of_inliers(scratch, [&](std::size_t i) { return std::abs(scratch.residuals[i]); });
}

/// The predicted variances, plus what the residuals show that they miss.
void find_variances(std::span<const Match> matches, double deviation, FitScratch& scratch) {
  const double predicted = median_of_inliers(
      scratch, [&](std::size_t i) { return static_cast<double>(matches[i].variance); });
  const double missing = std::max(deviation * deviation - predicted, 0.0);
  for (std::size_t i = 0; i < matches.size(); ++i) {
    scratch.variances[i] = matches[i].variance + missing;
  }
}

/// The normal equations of the first `terms` terms, with the prior.
struct Equations {
  FieldNormal matrix = FieldNormal::Identity();
  FieldTerms right = FieldTerms::Zero();

  Equations(std::span<const Match> matches, const FitScratch& scratch, int terms) {
    for (int k = 0; k < terms; ++k) matrix(k, k) = 1 / (kPriorSigmas[k] * kPriorSigmas[k]);
    for (std::size_t i = 0; i < matches.size(); ++i) {
      const double weight = scratch.weights[i] / scratch.variances[i];
      const FieldFactors& f = scratch.factors[i];
      for (int k = 0; k < terms; ++k) {
        for (int j = 0; j <= k; ++j) matrix(k, j) += weight * f[k] * f[j];
        right[k] += weight * f[k] * matches[i].rows;
      }
    }
    matrix = FieldNormal(matrix.selfadjointView<Eigen::Lower>());
  }
};

/// Weights that decrease with the residuals (Geman and McClure). Residuals of the size of `scale`
/// have a quarter of the weight of small ones.
void weigh(double scale, FitScratch& scratch) {
  for (std::size_t i = 0; i < scratch.residuals.size(); ++i) {
    const double r = scratch.residuals[i] / scale;
    scratch.weights[i] = 1 / ((1 + r * r) * (1 + r * r));
  }
}

/// Fits all terms again and again, with weights that become more selective.
double refine(std::span<const Match> matches, FieldTerms& terms, FitScratch& scratch) {
  find_residuals(matches, terms, scratch);
  double deviation = robust_deviation(scratch);
  for (int round = 0; round < kFitRounds; ++round) {
    find_variances(matches, deviation, scratch);
    constexpr double kNarrowest = 0.15;  // [px]
    const bool first = round < static_cast<int>(kFirstScales.size());
    weigh(first ? kFirstScales[round] : std::clamp(3 * deviation, kNarrowest, kInlierLimit),
          scratch);
    const Equations equations(matches, scratch, kFieldTerms);
    terms = equations.matrix.ldlt().solve(equations.right);
    find_residuals(matches, terms, scratch);
    deviation = robust_deviation(scratch);
  }
  return deviation;
}

double largest_deviation(const FieldNormal& covariance, int terms, int width, int height) {
  double largest = 0;
  for_extreme_points(width, height, [&](double x, double y) {
    const FieldFactors factors = field_factors(x, y, width, height);
    double variance = 0;
    for (int k = 0; k < terms; ++k) {
      for (int j = 0; j < terms; ++j) variance += factors[k] * factors[j] * covariance(k, j);
    }
    largest = std::max(largest, variance);
  });
  return std::sqrt(largest);
}

/// Fits a model with fewer terms to the matches as they were weighted for all terms.
FieldModel fit_model(std::span<const Match> matches, int terms, int width, int height,
                     FitScratch& scratch) {
  const Equations equations(matches, scratch, terms);
  const Eigen::LDLT<FieldNormal> solver(equations.matrix);
  const FieldTerms solution = solver.solve(equations.right);
  std::array<double, kFieldTerms> values{};
  for (int k = 0; k < terms; ++k) values[k] = solution[k];
  FieldModel model;
  model.terms = terms;
  model.field = field_of(values);
  model.deviation = largest_deviation(solver.solve(FieldNormal::Identity()), terms, width, height);
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (scratch.residuals[i] >= kInlierLimit || scratch.residuals[i] <= -kInlierLimit) continue;
    double residual = matches[i].rows;
    for (int k = 0; k < terms; ++k) residual -= values[k] * scratch.factors[i][k];
    const double square = residual * residual / scratch.variances[i];
    model.chi_square += std::min(square, kResidualCap * kResidualCap);
  }
  return model;
}

void count_inliers(std::span<const Match> matches, int width, int height, const FitScratch& scratch,
                   FieldFit& fit) {
  constexpr int kColumns = 4, kRows = 3;
  std::array<int, kColumns * kRows> cells{};
  int negative = 0;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (std::abs(scratch.residuals[i]) >= kInlierLimit) continue;
    ++fit.inliers;
    negative += matches[i].disparity() < -1 ? 1 : 0;
    const int column = static_cast<int>(matches[i].x_right) * kColumns / width;
    const int row = static_cast<int>(matches[i].y_left) * kRows / height;
    ++cells[std::clamp(row, 0, kRows - 1) * kColumns + std::clamp(column, 0, kColumns - 1)];
  }
  for (const int count : cells) fit.occupied_cells += count >= 2 ? 1 : 0;
  if (fit.inliers > 0) fit.negative_share = static_cast<double>(negative) / fit.inliers;
}

}  // namespace

void FitScratch::reserve(std::size_t matches) {
  factors.reserve(matches);
  for (std::vector<double>* values : {&residuals, &sorted, &weights, &variances}) {
    values->reserve(matches);
  }
}

FieldFit fit_field(std::span<const Match> matches, int width, int height, FitScratch& scratch) {
  FieldFit fit;
  const std::size_t count = matches.size();
  if (count < kFewestMatches) return fit;
  scratch.factors.resize(count);
  scratch.residuals.resize(count);
  scratch.weights.resize(count);
  scratch.variances.resize(count);
  scratch.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    scratch.factors[i] = field_factors(matches[i].x_right, matches[i].y_left, width, height);
  }
  FieldTerms terms = sample_consensus(matches, scratch.factors);
  fit.residual = refine(matches, terms, scratch);
  count_inliers(matches, width, height, scratch, fit);
  for (std::size_t i = 0; i < fit.models.size(); ++i) {
    fit.models[i] = fit_model(matches, kModelTerms[i], width, height, scratch);
  }
  return fit;
}

}  // namespace mtstereo
