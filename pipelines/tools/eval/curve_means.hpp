// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "tools/eval/curve.hpp"
#include "tools/eval/datasets.hpp"

namespace mtstereo::eval {

/// The sweep of one method.
struct MethodSweep {
  std::string method;
  Sweep sweep;
};

/// The pointwise mean of sweeps: the unweighted mean, over the pairs, of the figures of each pair
/// at the same setting. A point has errors only if every pair has them; otherwise different parts
/// of the curve would be means over different pairs.
class SweepMean {
 public:
  /// All sweeps must have the settings of the first.
  void add(const Sweep& sweep);
  /// Empty if nothing was added.
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

/// Accumulates the sweeps of all pairs. It keeps only sums, so memory does not grow with the data
/// set.
class CurveCollector {
 public:
  explicit CurveCollector(std::vector<std::string> methods);

  /// Adds a pair if every method has a sweep with errors. Otherwise ignores the pair and lists it
  /// as left out, because all curves must be means over the same pairs.
  void add(const std::string& pair, const std::vector<MethodSweep>& sweeps);
  CurveMeans means() const;

 private:
  std::vector<std::string> methods_;
  std::vector<SweepMean> sums_;
  int pairs_ = 0;
  std::vector<Problem> left_out_;
};

}  // namespace mtstereo::eval
