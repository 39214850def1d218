// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/clocks/row_clock.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "lib/median.hpp"

namespace mtstereo::run {
namespace {

constexpr int kFieldTerms = 5;
constexpr int kTerms = kFieldTerms + 3;  // with the next ones
// How far points move in the time between the frames, relative to what the speeds suggest; the
// same for the time by which the right recording is later, and for its change.
constexpr int kScale = kFieldTerms, kLate = kFieldTerms + 1, kDrift = kFieldTerms + 2;
constexpr double kLeastScale = 0.75, kMostScale = 1.33;
constexpr int kIterations = 15;
constexpr double kWide = 1.5, kNarrower = 0.7;  // the limit of the first iterations [px]
constexpr double kOutlier = 3;                  // robust standard deviations
constexpr double kFloor = 0.05;                 // of the standard deviation of a match [px]
constexpr double kAgreement = 0.3;              // of the rows of matches that agree [px]
constexpr double kSignificance = 3;             // standard deviations of a drift
constexpr double kRelevance = 0.1;              // of a frame: what a drift changes from end to end
constexpr double kLargestDrift = 1e-3;          // of clocks of recorders
constexpr double kSystematic = 0.005;           // error that matches may share [px]
constexpr int kFewestMatches = 60;
constexpr std::size_t kFewestGroups = 4;

using Vector = Eigen::Matrix<double, kTerms, 1>;
using Matrix = Eigen::Matrix<double, kTerms, kTerms>;

// One equation. Its speed has an error, which would make the result smaller than it is: so the
// other view's speed, whose error is independent, weighs the equation (instrumental variables).
// Where patches are distorted, displacements are underestimated by some percent; that of frames at
// both sides of the right time shows by how much (kScale).
struct Equation {
  Vector factors;
  Vector instruments;
  double rows = 0;   // [px]
  double speed = 0;  // [px/s]
  double variance = 0;
  std::size_t group = 0;

  double rest(const Vector& terms) const { return rows - factors.dot(terms); }
};

Vector factors_of(const RowMatch& match, double speed, double lateness, double time) {
  Vector factors;
  factors << 1, match.x, match.y, match.x * match.y, match.y * match.y, speed * lateness, -speed,
      -speed * time;
  return factors;
}

struct System {
  std::vector<Equation> equations;
  std::size_t groups = 0;
  double middle = 0, half = 1;  // of the times [s]
};

System system_of(const std::vector<std::vector<MatchedPair>>& groups) {
  System system;
  double first = 0, last = 0;
  bool any = false;
  for (const auto& group : groups) {
    for (const MatchedPair& pair : group) {
      if (pair.matches.empty()) continue;
      first = any ? std::min(first, pair.time) : pair.time;
      last = any ? std::max(last, pair.time) : pair.time;
      any = true;
    }
  }
  system.middle = (first + last) / 2;
  system.half = std::max((last - first) / 2, 1e-3);
  for (const auto& group : groups) {
    const std::size_t before = system.equations.size();
    for (const MatchedPair& pair : group) {
      for (const RowMatch& match : pair.matches) {
        const double time = (pair.time - system.middle) / system.half;
        const Vector left = factors_of(match, match.left_speed, pair.lateness, time);
        const Vector right = factors_of(match, match.right_speed, pair.lateness, time);
        const double variance = match.variance + kFloor * kFloor;
        system.equations.push_back(
            {left, right, match.rows, match.left_speed, variance, system.groups});
        system.equations.push_back(
            {right, left, match.rows, match.right_speed, variance, system.groups});
      }
    }
    system.groups += system.equations.size() > before ? 1 : 0;
  }
  return system;
}

// The standard deviation that half of the residuals suggest.
double spread(const System& system, const Vector& terms) {
  std::vector<double> rests;
  for (const Equation& each : system.equations) rests.push_back(std::abs(each.rest(terms)));
  return 1.4826 * median(std::move(rests));
}

// What a match with this residual counts: Tukey's biweight, and the derivative of its influence.
// That of outliers is negative, and few groups of such matches would make a system singular: it
// counts as zero, and the rest is reduced to the mean of all for normally distributed residuals.
struct Influence {
  double weight = 0, slope = 0;
};

Influence influence_of(const Equation& each, const Vector& terms, double limit) {
  constexpr double kAll = 0.515, kPositive = 0.587;  // the means for a limit of kOutlier
  const double part = each.rest(terms) / limit, square = part * part;
  if (square >= 1) return {};
  const double slope = (1 - square) * (1 - 5 * square);
  return {(1 - square) * (1 - square) / each.variance,
          std::max(slope, 0.0) * (kAll / kPositive) / each.variance};
}

// Terms that are not fitted, with their values.
struct Fixed {
  std::optional<double> scale, drift;
};

// A singular system has a solution, and the fixed terms are known exactly.
Matrix prior_of(const Fixed& fixed) {
  constexpr double kUnknown = 1e-9, kSure = 1e12;
  Matrix prior = kUnknown * Matrix::Identity();
  if (fixed.scale) prior(kScale, kScale) = kSure;
  if (fixed.drift) prior(kDrift, kDrift) = kSure;
  return prior;
}

// The result of a fit.
struct Solution {
  Vector terms = Vector::Zero();
  Matrix normal = Matrix::Zero();
  double limit = 0;  // of the residuals [px]
};

Solution solve(const System& system, const Fixed& fixed) {
  const Matrix prior = prior_of(fixed);
  Vector known = Vector::Zero();
  known[kScale] = fixed.scale.value_or(1);
  known[kDrift] = fixed.drift.value_or(0);
  Solution solution;
  solution.terms = known;
  for (int i = 0; i < kIterations; ++i) {
    // Few points move in front of many that do not: they must not be outliers from the start.
    solution.limit = std::max(
        {kOutlier * spread(system, solution.terms), 3 * kFloor, kWide * std::pow(kNarrower, i)});
    solution.normal = prior;
    Vector sums = prior * known;
    for (const Equation& each : system.equations) {
      const double weight = influence_of(each, solution.terms, solution.limit).weight;
      solution.normal += weight * each.instruments * each.factors.transpose();
      sums += weight * each.rows * each.instruments;
    }
    solution.terms = solution.normal.partialPivLu().solve(sums);
  }
  return solution;
}

// The covariance of the terms, from what they are without each group (jackknife): the matches of a
// group have errors in common. To first order; how weights change with the terms is included.
Matrix covariance_of(const System& system, const Fixed& fixed, const Solution& solution) {
  std::vector<Vector> scores(system.groups, Vector::Zero());
  std::vector<Matrix> parts(system.groups, Matrix::Zero());
  Matrix whole = prior_of(fixed);
  for (const Equation& each : system.equations) {
    const Influence influence = influence_of(each, solution.terms, solution.limit);
    scores[each.group] += influence.weight * each.rest(solution.terms) * each.instruments;
    parts[each.group] += influence.slope * each.instruments * each.factors.transpose();
  }
  for (const Matrix& part : parts) whole += part;
  std::vector<Vector> changes;
  Vector mean = Vector::Zero();
  const auto groups = static_cast<double>(system.groups);
  for (std::size_t i = 0; i < system.groups; ++i) {
    changes.emplace_back((whole - parts[i]).partialPivLu().solve(scores[i]));
    mean += changes.back() / groups;
  }
  Matrix covariance = Matrix::Zero();
  for (const Vector& change : changes) {
    covariance += (groups - 1) / groups * (change - mean) * (change - mean).transpose();
  }
  return covariance;
}

// By how much kSystematic in every match, with the worst sign, changes the time term.
double systematic_error(const System& system, const Solution& solution) {
  const Vector row = solution.normal.inverse().row(kLate).transpose();
  double sum = 0;
  for (const Equation& each : system.equations) {
    const double weight = influence_of(each, solution.terms, solution.limit).weight;
    sum += weight * std::abs(row.dot(each.instruments));
  }
  return kSystematic * sum;
}

// Leaves out what the matches do not decide: a scale that cannot be, and a drift that may be none
// or changes nothing that matters. Returns the standard deviation of the drift term.
double fit(const System& system, double period, double assumed_drift, Fixed& fixed,
           Solution& solution) {
  solution = solve(system, fixed);
  if (!(solution.terms[kScale] > kLeastScale && solution.terms[kScale] < kMostScale)) {
    fixed.scale = 1;
    solution = solve(system, fixed);
  }
  const double deviation = std::sqrt(covariance_of(system, fixed, solution)(kDrift, kDrift));
  const double assumed = assumed_drift * system.half * solution.terms[kScale];
  const double drift = std::abs(solution.terms[kDrift] + assumed);  // at the ends [s]
  const bool sure = drift > kSignificance * deviation;
  const bool relevant = 2 * drift > kRelevance * period;
  if (!(sure && relevant && drift < kLargestDrift * system.half)) {
    fixed.drift = -assumed;
    solution = solve(system, fixed);
  }
  return deviation;
}

// The matches that agree with the field if the lateness were `beside` more. Of those only that move
// enough for half a frame to make a difference.
int agreeing(const System& system, const Vector& terms, double half_frame, double beside) {
  return static_cast<int>(
      std::count_if(system.equations.begin(), system.equations.end(), [&](const Equation& each) {
        return std::abs(each.speed) * half_frame > kAgreement / 2 &&
               std::abs(each.rest(terms) + each.speed * beside) < kAgreement;
      }));
}

}  // namespace

std::optional<ClockCorrection> fit_rows(const std::vector<std::vector<MatchedPair>>& groups,
                                        double period, double assumed_drift) {
  const System system = system_of(groups);
  if (system.equations.size() < kFewestMatches || system.groups < kFewestGroups) {
    return std::nullopt;
  }
  Fixed fixed;
  Solution solution;
  const double drift_deviation = fit(system, period, assumed_drift, fixed, solution);
  const double scale = solution.terms[kScale];
  const double scatter = std::sqrt(covariance_of(system, fixed, solution)(kLate, kLate));
  ClockCorrection correction;
  correction.middle = system.middle;
  correction.late = solution.terms[kLate] / scale;
  correction.late_deviation = std::hypot(scatter, systematic_error(system, solution)) / scale;
  correction.drift = fixed.drift ? -assumed_drift : solution.terms[kDrift] / scale / system.half;
  correction.drift_deviation = drift_deviation / scale / system.half;
  const double half = period / 2, moved = half * scale;
  correction.matches = agreeing(system, solution.terms, half, 0);
  correction.matches_beside = std::max(agreeing(system, solution.terms, half, moved),
                                       agreeing(system, solution.terms, half, -moved));
  if (!std::isfinite(correction.late) || !std::isfinite(correction.late_deviation)) {
    return std::nullopt;
  }
  return correction;
}

}  // namespace mtstereo::run
