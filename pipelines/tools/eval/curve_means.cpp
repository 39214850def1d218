// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/curve_means.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mtstereo::eval {
namespace {

// Calls `change` with each figure of `target` and the corresponding one of `other`.
template <typename Change>
void for_figures(CurvePoint& target, const CurvePoint& other, Change change) {
  change(target.density, other.density);
  for (const CurveMeasure& measure : kCurveMeasures) {
    change(target.*measure.value, other.*measure.value);
  }
}

const MethodSweep* sweep_of(const std::vector<MethodSweep>& sweeps, const std::string& method) {
  const auto found = std::find_if(sweeps.begin(), sweeps.end(),
                                  [&](const MethodSweep& entry) { return entry.method == method; });
  return found == sweeps.end() ? nullptr : &*found;
}

}  // namespace

void SweepMean::add(const Sweep& sweep) {
  if (count_++ == 0) {
    sum_ = sweep;
    return;
  }
  for (std::size_t i = 0; i < sum_.points.size(); ++i) {
    // A NaN makes the sum NaN: not all pairs have that point.
    for_figures(sum_.points[i], sweep.points[i], [](double& sum, double value) { sum += value; });
  }
}

Sweep SweepMean::mean() const {
  Sweep result = sum_;
  for (CurvePoint& point : result.points) {
    for_figures(point, point, [this](double& value, double) { value /= count_; });
  }
  return result;
}

CurveCollector::CurveCollector(std::vector<std::string> methods)
    : methods_(std::move(methods)), sums_(methods_.size()) {}

void CurveCollector::add(const std::string& pair, const std::vector<MethodSweep>& sweeps) {
  std::vector<const Sweep*> found;
  for (const std::string& method : methods_) {
    const MethodSweep* entry = sweep_of(sweeps, method);
    if (entry == nullptr) {
      left_out_.push_back({pair, method + " has no result for it"});
      return;
    }
    if (std::isnan(density_range(entry->sweep).most)) {
      left_out_.push_back({pair, method + " has no disparity where there is ground truth"});
      return;
    }
    found.push_back(&entry->sweep);
  }
  for (std::size_t i = 0; i < found.size(); ++i) sums_[i].add(*found[i]);
  ++pairs_;
}

CurveMeans CurveCollector::means() const {
  CurveMeans result;
  result.pairs = pairs_;
  result.left_out = left_out_;
  if (pairs_ == 0) return result;
  for (std::size_t i = 0; i < methods_.size(); ++i) {
    result.methods.push_back({methods_[i], sums_[i].mean()});
  }
  return result;
}

}  // namespace mtstereo::eval
