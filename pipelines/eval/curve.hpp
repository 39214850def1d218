// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstddef>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "eval/metrics.hpp"

namespace mtstereo::eval {

/// What is left of a disparity map at one setting of a sweep, over all pixels with ground truth.
/// The errors are NaN where nothing could be compared.
struct CurvePoint {
  double density = kNone;  ///< pixels with an estimate / all pixels of the image [%]
  double avgerr = kNone;   ///< [px]
  double d_all = kNone;    ///< [%]
  double bad1 = kNone;     ///< [%]
};

/// An error that is told against density.
struct CurveMeasure {
  const char* name;
  const char* unit;
  double CurvePoint::*value;
};

inline constexpr std::array<CurveMeasure, 3> kCurveMeasures{{{"avgerr", "px", &CurvePoint::avgerr},
                                                             {"D-all", "%", &CurvePoint::d_all},
                                                             {"bad1", "%", &CurvePoint::bad1}}};

/// The densities at which methods are compared [%].
inline constexpr std::array<double, 9> kCurveDensities{10, 20, 30, 40, 50, 60, 70, 75, 80};

/// The largest threshold on a confidence; the smallest is 1, which every disparity reaches.
inline constexpr int kMostConfidence = 255;

/// The figures over a grid of settings: one row for each uniqueness ratio, one column for each
/// threshold on the confidence.
struct Sweep {
  /// StereoSGBM's or StereoBM's uniquenessRatio [%]; a single 0 where the matcher has none
  std::vector<int> ratios;
  /// A pixel counts where its confidence reaches this; 0 = the map as the matcher gives it, without
  /// filters
  std::vector<int> thresholds;
  std::vector<CurvePoint> points;  ///< row after row, ratios.size() * thresholds.size()

  const CurvePoint& at(std::size_t ratio, std::size_t threshold) const {
    return points[ratio * thresholds.size() + threshold];
  }
};

/// The point of a whole map.
CurvePoint point_of(const Evaluation& evaluation);

/// The points at the thresholds 1 .. kMostConfidence: at each those pixels of the estimate
/// (CV_32FC1 [px], NaN = none) count whose confidence (CV_8UC1) reaches it. Throws InputError where
/// the sizes differ.
std::vector<CurvePoint> threshold_points(const cv::Mat& estimate, const cv::Mat& confidence,
                                         const cv::Mat& truth);

/// The sweep of a matcher that tells its own confidence: one row of the thresholds above.
Sweep confidence_sweep(const cv::Mat& estimate, const cv::Mat& confidence, const cv::Mat& truth);

/// The rows of a sweep at one of its thresholds.
Sweep at_threshold(const Sweep& sweep, std::size_t threshold);

/// The error at a density [%]: linear between neighboring settings, and where several pairs of them
/// enclose the density, the least. Neighbors differ by one step in one setting, the ratio or the
/// threshold. So it is the curve itself where there is one row or one column, and else the lower
/// envelope. NaN where the density is not reached.
double error_at(const Sweep& sweep, double density, const CurveMeasure& measure);

/// The densities that a sweep reaches, at points with errors [%]; NaN where it has none.
struct DensityRange {
  double least = kNone;
  double most = kNone;
};
DensityRange density_range(const Sweep& sweep);

}  // namespace mtstereo::eval
