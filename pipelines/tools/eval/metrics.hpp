// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "mtstereo/image.hpp"
#include "tools/eval/datasets.hpp"

namespace mtstereo::eval {

inline constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// The thresholds t of "bad t" [px].
inline constexpr std::array<double, 4> kBadThresholds{0.5, 1, 2, 4};

/// Whether D-all counts this error at this true disparity, both in px of the original images.
inline bool is_outlier(double error, double truth) {
  // 5 % as 20 e >= truth: exact at the border, unlike 0.05 * truth.
  return error >= 3 && 20 * error >= truth;
}

/// The errors of an estimate over the pixels that have both ground truth and an estimate. NaN if
/// there is no such pixel.
struct Metrics {
  std::int64_t known = 0;     ///< pixels with ground truth
  std::int64_t compared = 0;  ///< pixels with ground truth and an estimate
  double avgerr = kNone;      ///< mean absolute error [px]
  double rms = kNone;         ///< root of the mean squared error [px]
  double d_all = kNone;       ///< D-all-est: error >= 3 px and >= 5 % of the truth [%]
  std::array<double, kBadThresholds.size()> bad{kNone, kNone, kNone, kNone};  ///< error > t [%]
  double known_density = kNone;  ///< compared / known [%]
};

/// Density and errors of a disparity map.
struct Evaluation {
  double density = kNone;      ///< pixels with an estimate / all pixels of the image [%]
  Metrics all;                 ///< over all pixels with ground truth
  std::optional<Metrics> noc;  ///< over those of them that are visible in both views, if known
  /// disparities in areas that are constant in both views, see count_flat_answers(); none if it is
  /// unknown
  std::optional<std::int64_t> flat_answers;
};

/// Compares an estimate with the truth (both CV_32FC1 [px], NaN = none) at the pixels where
/// `visible` (CV_8UC1) is not 0, or at all pixels if it is empty. Errors are divided by `scale`.
/// Throws UserError if the sizes differ.
Metrics measure(const cv::Mat& estimate, const cv::Mat& truth, const cv::Mat& visible = {},
                double scale = 1);

/// By how much most of the estimates are larger than the truth, if that is one factor far from 1,
/// as where the truth has another scale.
std::optional<double> foreign_factor(const cv::Mat& estimate, const cv::Mat& truth);

/// Compares as measure() does, with the density, for all pixels and, if known, for those visible in
/// both views, at the scale of the truth.
Evaluation evaluate(const cv::Mat& estimate, const GroundTruth& truth);

/// The same with the number of disparities in flat areas of these images.
Evaluation evaluate(const cv::Mat& estimate, const LoadedPair& images);

/// The same as the second for a disparity map of the library.
Evaluation evaluate(DisparityView estimate, const GroundTruth& truth);

/// A disparity map of the library as CV_32FC1 [px], NaN = none.
cv::Mat to_float(DisparityView disparity, int offset = 0);

/// The evaluation of one pair and its weight in the mean.
struct WeightedEvaluation {
  const Evaluation* evaluation = nullptr;
  double weight = 1;
};

/// The mean over pairs: errors are weighted, densities are not. A pair without a compared pixel is
/// left out of the mean error. `noc` is the mean over the pairs that have it, none if no pair has.
/// Numbers of pixels, `flat_answers` too, are sums.
Evaluation mean(const std::vector<WeightedEvaluation>& pairs);

}  // namespace mtstereo::eval
