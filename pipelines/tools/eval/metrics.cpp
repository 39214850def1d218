// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/metrics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "lib/outputs/user_error.hpp"
#include "tools/eval/flat_answers.hpp"

namespace mtstereo::eval {
namespace {

// part / whole [%]; NaN if the whole is 0.
double percent(std::int64_t part, std::int64_t whole) {
  if (whole == 0) return kNone;
  return 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

// A running weighted mean that ignores NaN.
class WeightedMean {
 public:
  void add(double value, double weight) {
    if (std::isnan(value)) return;
    sum_ += value * weight;
    weights_ += weight;
  }
  // NaN if there is no value.
  double value() const { return weights_ > 0 ? sum_ / weights_ : kNone; }

 private:
  double sum_ = 0;
  double weights_ = 0;
};

void require_same_size(const cv::Mat& estimate, const cv::Mat& truth) {
  if (estimate.size() == truth.size()) return;
  throw UserError("the ground truth is " + std::to_string(truth.cols) + "x" +
                  std::to_string(truth.rows) + ", the disparity map " +
                  std::to_string(estimate.cols) + "x" + std::to_string(estimate.rows));
}

// Sums over pixels, from which Metrics are computed.
struct Sums {
  std::int64_t known = 0;
  std::int64_t compared = 0;
  double error = 0;
  double squared = 0;
  std::int64_t outliers = 0;
  std::array<std::int64_t, kBadThresholds.size()> bad{};

  // The error and the true disparity, both in px of the original images.
  void add(double e, double truth) {
    ++compared;
    error += e;
    squared += e * e;
    outliers += is_outlier(e, truth);
    for (std::size_t i = 0; i < bad.size(); ++i) bad[i] += e > kBadThresholds[i];
  }
};

Metrics finish(const Sums& sums) {
  Metrics metrics;
  metrics.known = sums.known;
  metrics.compared = sums.compared;
  metrics.known_density = percent(sums.compared, sums.known);
  if (sums.compared == 0) return metrics;
  const auto count = static_cast<double>(sums.compared);
  metrics.avgerr = sums.error / count;
  metrics.rms = std::sqrt(sums.squared / count);
  metrics.d_all = percent(sums.outliers, sums.compared);
  for (std::size_t i = 0; i < sums.bad.size(); ++i) {
    metrics.bad[i] = percent(sums.bad[i], sums.compared);
  }
  return metrics;
}

double density_of(const cv::Mat& estimate) {
  std::int64_t predicted = 0;
  for (int y = 0; y < estimate.rows; ++y) {
    const auto* row = estimate.ptr<float>(y);
    predicted += std::count_if(row, row + estimate.cols, [](float v) { return !std::isnan(v); });
  }
  return percent(predicted, static_cast<std::int64_t>(estimate.total()));
}

struct WeightedMetrics {
  const Metrics* metrics;
  double weight;
};

Metrics mean_of(const std::vector<WeightedMetrics>& list) {
  Metrics result;
  WeightedMean avgerr, rms, d_all, known_density;
  std::array<WeightedMean, kBadThresholds.size()> bad;
  for (const auto& [metrics, weight] : list) {
    result.known += metrics->known;
    result.compared += metrics->compared;
    avgerr.add(metrics->avgerr, weight);
    rms.add(metrics->rms, weight);
    d_all.add(metrics->d_all, weight);
    known_density.add(metrics->known_density, 1);
    for (std::size_t i = 0; i < bad.size(); ++i) bad[i].add(metrics->bad[i], weight);
  }
  result.avgerr = avgerr.value();
  result.rms = rms.value();
  result.d_all = d_all.value();
  result.known_density = known_density.value();
  for (std::size_t i = 0; i < bad.size(); ++i) result.bad[i] = bad[i].value();
  return result;
}

}  // namespace

Metrics measure(const cv::Mat& estimate, const cv::Mat& truth, const cv::Mat& visible,
                double scale) {
  require_same_size(estimate, truth);
  if (!visible.empty()) require_same_size(estimate, visible);
  Sums sums;
  for (int y = 0; y < truth.rows; ++y) {
    const auto* wanted = truth.ptr<float>(y);
    const auto* found = estimate.ptr<float>(y);
    const auto* seen = visible.empty() ? nullptr : visible.ptr<std::uint8_t>(y);
    for (int x = 0; x < truth.cols; ++x) {
      if (std::isnan(wanted[x]) || (seen != nullptr && seen[x] == 0)) continue;
      ++sums.known;
      if (std::isnan(found[x])) continue;
      const double expected = wanted[x];
      sums.add(std::abs(found[x] - expected) / scale, expected / scale);
    }
  }
  return finish(sums);
}

std::optional<double> foreign_factor(const cv::Mat& estimate, const cv::Mat& truth) {
  constexpr std::size_t kLeast = 100;
  constexpr double kFar = 1.2, kSame = 0.05;
  std::vector<float> factors;
  for (int y = 0; y < truth.rows; ++y) {
    for (int x = 0; x < truth.cols; ++x) {
      const float factor = estimate.at<float>(y, x) / truth.at<float>(y, x);
      if (std::isfinite(factor) && factor > 0) factors.push_back(factor);
    }
  }
  if (factors.size() < kLeast) return std::nullopt;
  const auto middle = factors.begin() + static_cast<std::ptrdiff_t>(factors.size() / 2);
  std::nth_element(factors.begin(), middle, factors.end());
  const double median = *middle;
  if (median < kFar && median > 1 / kFar) return std::nullopt;
  const auto same = std::count_if(factors.begin(), factors.end(), [median](float factor) {
    return std::abs(factor - median) <= kSame * median;
  });
  if (2 * static_cast<std::size_t>(same) < factors.size()) return std::nullopt;
  return median;
}

Evaluation evaluate(const cv::Mat& estimate, const GroundTruth& truth) {
  Evaluation result;
  result.all = measure(estimate, truth.disparity, {}, truth.scale);
  if (!truth.visible.empty()) {
    result.noc = measure(estimate, truth.disparity, truth.visible, truth.scale);
  }
  result.density = density_of(estimate);
  return result;
}

Evaluation evaluate(const cv::Mat& estimate, const LoadedPair& images) {
  Evaluation result = evaluate(estimate, images.truth);
  result.flat_answers = count_flat_answers(estimate, images.left, images.right);
  return result;
}

Evaluation evaluate(DisparityView estimate, const GroundTruth& truth) {
  return evaluate(to_float(estimate), truth);
}

cv::Mat to_float(DisparityView disparity, int offset) {
  cv::Mat result(disparity.height, disparity.width, CV_32FC1);
  for (int y = 0; y < disparity.height; ++y) {
    const std::int32_t* source = disparity.row(y);
    auto* target = result.ptr<float>(y);
    for (int x = 0; x < disparity.width; ++x) {
      target[x] = source[x] == kNoDisparity
                      ? std::numeric_limits<float>::quiet_NaN()
                      : static_cast<float>(source[x]) / static_cast<float>(kDisparityOne) +
                            static_cast<float>(offset);
    }
  }
  return result;
}

Evaluation mean(const std::vector<WeightedEvaluation>& pairs) {
  Evaluation result;
  WeightedMean density;
  std::vector<WeightedMetrics> all, noc;
  for (const auto& [evaluation, weight] : pairs) {
    density.add(evaluation->density, 1);
    all.push_back({&evaluation->all, weight});
    if (evaluation->noc) noc.push_back({&*evaluation->noc, weight});
    if (evaluation->flat_answers) {
      result.flat_answers = result.flat_answers.value_or(0) + *evaluation->flat_answers;
    }
  }
  result.density = density.value();
  result.all = mean_of(all);
  if (!noc.empty()) result.noc = mean_of(noc);
  return result;
}

}  // namespace mtstereo::eval
