// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "eval/curve.hpp"
#include "eval/datasets.hpp"

namespace mtstereo::eval {

/// What a method reached over a sweep of its settings.
struct MethodSweep {
  std::string method;
  Sweep sweep;
};

/// The mean of sweeps, point by point: first each pair's own figure, then the plain mean over the
/// pairs, at the same settings for all. The errors are there only where every pair has them, or the
/// curve would change its pairs on the way.
class SweepMean {
 public:
  /// All sweeps have the settings of the first.
  void add(const Sweep& sweep);
  /// Empty before the first.
  Sweep mean() const;

 private:
  Sweep sum_;
  int count_ = 0;
};

/// The means of all methods.
struct CurveMeans {
  int pairs = 0;
  std::vector<Problem> left_out;
  std::vector<MethodSweep> methods;
};

/// Gathers the sweeps of pair after pair. It keeps sums only, so that a data set may be large.
class CurveCollector {
 public:
  explicit CurveCollector(std::vector<std::string> methods);

  /// Takes a pair in where every method has a sweep with something to compare; else none of its
  /// sweeps, and it is listed as left out: all curves are to be over the same pairs.
  void add(const std::string& pair, const std::vector<MethodSweep>& sweeps);
  CurveMeans means() const;

 private:
  std::vector<std::string> methods_;
  std::vector<SweepMean> sums_;
  int pairs_ = 0;
  std::vector<Problem> left_out_;
};

}  // namespace mtstereo::eval
