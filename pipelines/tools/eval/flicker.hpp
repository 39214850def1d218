// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <deque>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "tools/eval/metrics.hpp"

namespace mtstereo::eval {

/// The number of frames that flicker is measured on.
inline constexpr int kFlickerFrames = 6;

/// The frames before them with parameters that use the last map: from then on the density is that
/// of a long stream.
inline constexpr int kFlickerLead = 12;

/// How the disparity maps of a scene change from frame to frame.
struct Flicker {
  double density = kNone;      ///< mean share of all pixels with a disparity [%]
  double come_and_go = kNone;  ///< of the pixels with a disparity in any map: not in all maps [%]
  double spread = kNone;       ///< mean standard deviation of the pixels with one in all maps [px]
  double d_all = kNone;        ///< mean of the maps [%], over all pixels with ground truth
  double avgerr = kNone;       ///< the same [px]
  double edges = kNone;        ///< wrong_at_edges() of the last map [%]
};

/// Compares disparity maps of the same size (CV_32FC1 [px], NaN = none). Throws UserError if the
/// sizes differ or there are fewer than two maps.
Flicker measure_flicker(const std::vector<cv::Mat>& maps);

/// The last kFlickerFrames maps of a stream and their errors.
class FlickerWindow {
 public:
  /// Adds a map and its ground truth, which have the same size.
  void add(const cv::Mat& map, const GroundTruth& truth);
  /// Their flicker and errors; none if there are fewer maps. Throws UserError as
  /// measure_flicker().
  std::optional<Flicker> measure() const;

 private:
  std::deque<cv::Mat> maps_;
  std::deque<Metrics> metrics_;
  double edges_ = kNone;  ///< of the last one
};

/// The mean over pairs; a figure that is NaN is left out.
Flicker mean(const std::vector<Flicker>& list);

/// The views of frame 0, 1, ...: fresh Gaussian noise of this standard deviation
/// [gray values] in both views.
void add_flicker_noise(double sigma, int frame, cv::Mat& left, cv::Mat& right);

}  // namespace mtstereo::eval
