// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstddef>
#include <opencv2/core.hpp>
#include <vector>

#include "tools/eval/metrics.hpp"

namespace mtstereo::eval {

/// Density and errors of a disparity map at one setting of a sweep, over all pixels with ground
/// truth. The errors are NaN if no pixel could be compared.
struct CurvePoint {
  double density = kNone;  ///< pixels with an estimate / all pixels of the image [%]
  double avgerr = kNone;   ///< [px of the original images]
  double d_all = kNone;    ///< [%]
  double bad1 = kNone;     ///< [%]
};

/// An error measure that is reported against density.
struct CurveMeasure {
  const char* name;
  const char* unit;
  double CurvePoint::*value;
};

inline constexpr CurveMeasure kDAllMeasure{"D-all", "%", &CurvePoint::d_all};
inline constexpr std::array<CurveMeasure, 3> kCurveMeasures{
    {{"avgerr", "px", &CurvePoint::avgerr}, kDAllMeasure, {"bad1", "%", &CurvePoint::bad1}}};

/// The densities at which methods are compared [%].
inline constexpr std::array<double, 9> kCurveDensities{10, 20, 30, 40, 50, 60, 70, 75, 80};

/// The errors at which the densities of methods are compared: D-all [%].
inline constexpr std::array<double, 4> kCurveDAlls{0.5, 1, 2, 5};

/// The largest confidence threshold. The smallest is 1, which every disparity passes.
inline constexpr int kMostConfidence = 255;

/// The figures over a grid of settings: one row per uniqueness ratio, one column per confidence
/// threshold.
struct Sweep {
  /// uniquenessRatio of StereoSGBM or StereoBM [%]; a single 0 for a matcher without one
  std::vector<int> ratios;
  /// A pixel counts if its confidence is at least this; 0 = the unfiltered map of the matcher
  std::vector<int> thresholds;
  std::vector<CurvePoint> points;  ///< row-major, ratios.size() * thresholds.size()

  const CurvePoint& at(std::size_t ratio, std::size_t threshold) const {
    return points[ratio * thresholds.size() + threshold];
  }
};

/// The point of an unthresholded map.
CurvePoint point_of(const Evaluation& evaluation);

/// The points at the thresholds 1 .. kMostConfidence. At each threshold, the pixels of the estimate
/// (CV_32FC1 [px], NaN = none) count whose confidence (CV_8UC1) is at least the threshold. Throws
/// UserError if the sizes differ.
std::vector<CurvePoint> threshold_points(const cv::Mat& estimate, const cv::Mat& confidence,
                                         const GroundTruth& truth);

/// The sweep of a matcher that reports its own confidence: one row of the thresholds above.
Sweep confidence_sweep(const cv::Mat& estimate, const cv::Mat& confidence,
                       const GroundTruth& truth);

/// The column of a sweep at one of its thresholds.
Sweep at_threshold(const Sweep& sweep, std::size_t threshold);

/// The error at a density [%], interpolated linearly between neighboring settings; the smallest one
/// if several pairs of neighbors enclose the density. Neighbors differ by one step in one setting,
/// the ratio or the threshold. A sweep with one row or one column thus gives the curve itself, any
/// other the lower envelope. NaN if the density is not reached.
double error_at(const Sweep& sweep, double density, const CurveMeasure& measure);

/// The largest density [%] at which the error is at most `error`, interpolated linearly between
/// neighboring settings, as by error_at(). A sweep whose errors are all smaller gives the largest
/// density that it reaches. NaN if all its errors are larger.
double density_at(const Sweep& sweep, double error, const CurveMeasure& measure);

/// The range of densities of the points that have errors [%]; NaN if there is none.
struct DensityRange {
  double least = kNone;
  double most = kNone;
};
DensityRange density_range(const Sweep& sweep);

}  // namespace mtstereo::eval
