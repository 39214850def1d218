// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/curve.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "lib/outputs/user_error.hpp"

namespace mtstereo::eval {
namespace {

// Sums over the pixels with one confidence, or with at least one confidence.
struct Bin {
  std::int64_t predicted = 0;
  std::int64_t compared = 0;
  double error = 0;
  std::int64_t outliers = 0;
  std::int64_t bad1 = 0;

  // The error and the true disparity, both in px of the original images.
  void compare(double e, double truth) {
    ++compared;
    error += e;
    outliers += is_outlier(e, truth);
    bad1 += e > 1;
  }
  void add(const Bin& other) {
    predicted += other.predicted;
    compared += other.compared;
    error += other.error;
    outliers += other.outliers;
    bad1 += other.bad1;
  }
};

using Bins = std::array<Bin, kMostConfidence + 1>;

Bins bins_of(const cv::Mat& estimate, const cv::Mat& confidence, const GroundTruth& truth) {
  Bins bins{};
  for (int y = 0; y < estimate.rows; ++y) {
    const auto* found = estimate.ptr<float>(y);
    const auto* trusted = confidence.ptr<std::uint8_t>(y);
    const auto* wanted = truth.disparity.ptr<float>(y);
    for (int x = 0; x < estimate.cols; ++x) {
      if (std::isnan(found[x])) continue;
      Bin& bin = bins[trusted[x]];
      ++bin.predicted;
      if (std::isnan(wanted[x])) continue;
      const double expected = wanted[x];
      bin.compare(std::abs(found[x] - expected) / truth.scale, expected / truth.scale);
    }
  }
  return bins;
}

CurvePoint point_of(const Bin& sum, std::size_t pixels) {
  CurvePoint point;
  if (pixels > 0) {
    point.density = 100.0 * static_cast<double>(sum.predicted) / static_cast<double>(pixels);
  }
  if (sum.compared == 0) return point;
  const auto compared = static_cast<double>(sum.compared);
  point.avgerr = sum.error / compared;
  point.d_all = 100.0 * static_cast<double>(sum.outliers) / compared;
  point.bad1 = 100.0 * static_cast<double>(sum.bad1) / compared;
  return point;
}

// Interpolates linearly between two points; NaN if they do not enclose the density or one has no
// error.
double between(const CurvePoint& a, const CurvePoint& b, double density,
               const CurveMeasure& measure) {
  const double low = a.*measure.value, high = b.*measure.value;
  if (std::isnan(low) || std::isnan(high)) return kNone;
  if (!(std::min(a.density, b.density) <= density && density <= std::max(a.density, b.density))) {
    return kNone;
  }
  if (a.density == b.density) return std::min(low, high);
  const double share = (density - a.density) / (b.density - a.density);
  return low + share * (high - low);
}

// The largest density between two points where the error, which is linear between them, is at most
// this; NaN if it is larger everywhere or a point has no error.
double densest_between(const CurvePoint& a, const CurvePoint& b, double error,
                       const CurveMeasure& measure) {
  const CurvePoint& good = a.*measure.value <= b.*measure.value ? a : b;
  const CurvePoint& bad = &good == &a ? b : a;
  const double least = good.*measure.value, most = bad.*measure.value;
  if (std::isnan(least) || std::isnan(most) || least > error) return kNone;
  if (most <= error || bad.density <= good.density) return std::max(a.density, b.density);
  return good.density + (error - least) / (most - least) * (bad.density - good.density);
}

// Calls `consider` with each pair of neighbors in a sweep, and with each setting as both of a pair.
template <typename Consider>
void for_neighbors(const Sweep& sweep, Consider consider) {
  for (std::size_t i = 0; i < sweep.ratios.size(); ++i) {
    for (std::size_t j = 0; j < sweep.thresholds.size(); ++j) {
      const CurvePoint& here = sweep.at(i, j);
      consider(here, here);
      if (i > 0) consider(sweep.at(i - 1, j), here);
      if (j > 0) consider(sweep.at(i, j - 1), here);
    }
  }
}

}  // namespace

CurvePoint point_of(const Evaluation& evaluation) {
  static_assert(kBadThresholds[1] == 1);
  const Metrics& all = evaluation.all;
  return {evaluation.density, all.avgerr, all.d_all, all.bad[1]};
}

std::vector<CurvePoint> threshold_points(const cv::Mat& estimate, const cv::Mat& confidence,
                                         const GroundTruth& truth) {
  if (estimate.size() != confidence.size() || estimate.size() != truth.disparity.size()) {
    throw UserError("disparity map, confidence and ground truth have different sizes");
  }
  const Bins bins = bins_of(estimate, confidence, truth);
  std::vector<CurvePoint> points(kMostConfidence);
  Bin sum;
  for (int threshold = kMostConfidence; threshold >= 1; --threshold) {
    sum.add(bins[static_cast<std::size_t>(threshold)]);
    points[static_cast<std::size_t>(threshold) - 1] = point_of(sum, estimate.total());
  }
  return points;
}

Sweep confidence_sweep(const cv::Mat& estimate, const cv::Mat& confidence,
                       const GroundTruth& truth) {
  Sweep sweep;
  sweep.ratios = {0};
  sweep.thresholds.resize(kMostConfidence);
  std::iota(sweep.thresholds.begin(), sweep.thresholds.end(), 1);
  sweep.points = threshold_points(estimate, confidence, truth);
  return sweep;
}

Sweep at_threshold(const Sweep& sweep, std::size_t threshold) {
  Sweep result;
  result.ratios = sweep.ratios;
  result.thresholds = {sweep.thresholds[threshold]};
  for (std::size_t i = 0; i < sweep.ratios.size(); ++i) {
    result.points.push_back(sweep.at(i, threshold));
  }
  return result;
}

double error_at(const Sweep& sweep, double density, const CurveMeasure& measure) {
  double least = kNone;
  // fmin() and fmax() ignore NaN.
  for_neighbors(sweep, [&](const CurvePoint& a, const CurvePoint& b) {
    least = std::fmin(least, between(a, b, density, measure));
  });
  return least;
}

double density_at(const Sweep& sweep, double error, const CurveMeasure& measure) {
  double most = kNone;
  for_neighbors(sweep, [&](const CurvePoint& a, const CurvePoint& b) {
    most = std::fmax(most, densest_between(a, b, error, measure));
  });
  return most;
}

DensityRange density_range(const Sweep& sweep) {
  DensityRange range;
  for (const CurvePoint& point : sweep.points) {
    if (std::isnan(point.avgerr)) continue;
    range.least = std::fmin(range.least, point.density);
    range.most = std::fmax(range.most, point.density);
  }
  return range;
}

}  // namespace mtstereo::eval
