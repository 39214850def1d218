// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/clocks/lag_search.hpp"

#include <algorithm>
#include <cmath>

namespace mtstereo::run {
namespace {

constexpr double kLeastOverlap = 2;    // [s]
constexpr double kFullOverlap = 10;    // of which on the score is the correlation [s]
constexpr double kClip = 4;            // larger values count as so many standard deviations
constexpr double kNeighborhood = 0.2;  // of a peak [s]

// A signature at equal steps of time: one row per feature.
struct Series {
  double start = 0;  // [s]
  int length = 0;
  cv::Mat values;                // CV_64F: kFeatures x length
  std::vector<double> energies;  // sums of the squares of the columns before each one
};

cv::Mat resampled(const MotionSignature& signature, double step) {
  const std::vector<double>& times = signature.times;
  const int length = 1 + static_cast<int>((times.back() - times.front()) / step);
  cv::Mat values(length, MotionSignature::kFeatures, CV_64F);
  std::size_t i = 0;
  for (int k = 0; k < length; ++k) {
    const double time = times.front() + k * step;
    while (i + 2 < times.size() && times[i + 1] < time) ++i;
    const std::size_t next = std::min(i + 1, times.size() - 1);
    const double span = times[next] - times[i];
    const double part = span > 0 ? std::clamp((time - times[i]) / span, 0.0, 1.0) : 0;
    for (int f = 0; f < values.cols; ++f) {
      values.at<double>(k, f) = (1 - part) * signature.features.at<float>(static_cast<int>(i), f) +
                                part * signature.features.at<float>(static_cast<int>(next), f);
    }
  }
  return values.t();
}

// Smooths the rows by a Gaussian with this standard deviation.
cv::Mat smoothed(const cv::Mat& values, double sigma) {
  const int reach = static_cast<int>(std::ceil(3 * sigma));
  cv::Mat result = cv::Mat::zeros(values.size(), CV_64F);
  double total = 0;
  for (int k = -reach; k <= reach; ++k) total += std::exp(-0.5 * k * k / (sigma * sigma));
  for (int k = -reach; k <= reach; ++k) {
    const double weight = std::exp(-0.5 * k * k / (sigma * sigma)) / total;
    const int from = std::max(0, k), to = std::min(values.cols, values.cols + k);
    if (from >= to) continue;
    result.colRange(from - k, to - k) += weight * values.colRange(from, to);
  }
  return result;
}

// Subtracts the mean of a row and limits its outliers; returns its variance.
double condition(cv::Mat row) {
  double deviation = 0;
  for (int i = 0; i < 3; ++i) {
    cv::Scalar mean, spread;
    cv::meanStdDev(row, mean, spread);
    row -= mean;
    deviation = spread[0];
    row = cv::min(row, kClip * deviation);
    row = cv::max(row, -kClip * deviation);
  }
  return deviation * deviation;
}

// The three groups of features weigh the same, and so do the features of a group that have about
// the same variance.
void normalize(cv::Mat& values) {
  constexpr double kFloor = 0.1;  // of the mean variance of the group
  const int limits[] = {0, MotionSignature::kBands,
                        MotionSignature::kBands + MotionSignature::kFlowBands,
                        MotionSignature::kFeatures};
  for (int group = 0; group < 3; ++group) {
    const int count = limits[group + 1] - limits[group];
    std::vector<double> variances;
    double mean = 0;
    for (int f = limits[group]; f < limits[group + 1]; ++f) {
      variances.push_back(condition(values.row(f)));
      mean += variances.back() / count;
    }
    for (int f = limits[group]; f < limits[group + 1]; ++f) {
      const double variance = variances[static_cast<std::size_t>(f - limits[group])];
      values.row(f) /= std::sqrt(count * (variance + kFloor * mean) + 1e-30);
    }
  }
}

Series series_of(const MotionSignature& signature, double step, double sigma) {
  Series series;
  series.start = signature.times.front();
  series.values = smoothed(resampled(signature, step), sigma);
  normalize(series.values);
  series.length = series.values.cols;
  series.energies.push_back(0);
  for (int k = 0; k < series.length; ++k) {
    const cv::Mat column = series.values.col(k);
    series.energies.push_back(series.energies.back() + column.dot(column));
  }
  return series;
}

cv::Mat padded_spectrum(const cv::Mat& values, int length) {
  cv::Mat padded = cv::Mat::zeros(values.rows, length, CV_64F), spectrum;
  values.copyTo(padded.colRange(0, values.cols));
  cv::dft(padded, spectrum, cv::DFT_ROWS);
  return spectrum;
}

// The sum over all features of left(k) * right(k + lag); negative lags are at the end.
std::vector<double> products(const Series& left, const Series& right) {
  const int length = cv::getOptimalDFTSize(left.length + right.length);
  const cv::Mat a = padded_spectrum(left.values, length);
  const cv::Mat b = padded_spectrum(right.values, length);
  cv::Mat spectrum, sum, result;
  cv::mulSpectrums(b, a, spectrum, cv::DFT_ROWS, true);
  cv::reduce(spectrum, sum, 0, cv::REDUCE_SUM);
  cv::dft(sum, result, cv::DFT_INVERSE | cv::DFT_SCALE | cv::DFT_REAL_OUTPUT);
  return {result.ptr<double>(), result.ptr<double>() + length};
}

// The scores of all lags.
std::vector<Lag> all_lags(const Series& left, const Series& right, double step) {
  const std::vector<double> sums = products(left, right);
  std::vector<Lag> lags;
  for (int lag = 1 - left.length; lag < right.length; ++lag) {
    const int from = std::max(0, -lag), to = std::min(left.length, right.length - lag);
    Lag each;
    each.seconds = right.start - left.start + lag * step;
    each.overlap = (to - from) * step;
    if (each.overlap >= kLeastOverlap) {
      const double energy = (left.energies[to] - left.energies[from]) *
                            (right.energies[to + lag] - right.energies[from + lag]);
      const double sum = sums[lag < 0 ? lag + static_cast<int>(sums.size()) : lag];
      each.correlation = energy > 0 ? sum / std::sqrt(energy) : 0;
      each.score = each.correlation * std::sqrt(std::min(1.0, each.overlap / kFullOverlap));
    }
    lags.push_back(each);
  }
  return lags;
}

// The numbers of the peaks with a positive score, the highest one first.
std::vector<std::size_t> peaks(const std::vector<Lag>& lags) {
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < lags.size(); ++i) {
    const bool rises = i == 0 || lags[i - 1].score < lags[i].score;
    const bool falls = i + 1 == lags.size() || lags[i + 1].score <= lags[i].score;
    if (lags[i].score > 0 && rises && falls) result.push_back(i);
  }
  std::sort(result.begin(), result.end(),
            [&](std::size_t a, std::size_t b) { return lags[a].score > lags[b].score; });
  return result;
}

// Moves a peak to the maximum of the parabola through it and its neighbors.
Lag refined(const std::vector<Lag>& lags, std::size_t i, double step) {
  Lag lag = lags[i];
  if (i == 0 || i + 1 >= lags.size()) return lag;
  const double a = lags[i - 1].score, b = lags[i].score, c = lags[i + 1].score;
  const double bend = a - 2 * b + c;
  if (bend < 0) lag.seconds += step * std::clamp(0.5 * (a - c) / bend, -0.5, 0.5);
  return lag;
}

}  // namespace

std::vector<Lag> search_lags(const MotionSignature& left, const MotionSignature& right,
                             double period, double drift, int count) {
  std::vector<Lag> found;
  if (left.times.size() < 3 || right.times.size() < 3) return found;
  const double length =
      std::min(left.times.back() - left.times.front(), right.times.back() - right.times.front());
  // The lag changes along the recording by the drift: peaks must be wide enough to overlap.
  const double sigma = std::max(1.0, drift * length / period / 4);
  const std::vector<Lag> lags =
      all_lags(series_of(left, period, sigma), series_of(right, period, sigma), period);
  const double reach = std::max(3 * period, kNeighborhood);
  for (const std::size_t i : peaks(lags)) {
    if (static_cast<int>(found.size()) >= count) break;
    const Lag lag = refined(lags, i, period);
    const bool near = std::any_of(found.begin(), found.end(), [&](const Lag& other) {
      return std::abs(other.seconds - lag.seconds) < reach;
    });
    if (!near) found.push_back(lag);
  }
  return found;
}

}  // namespace mtstereo::run
