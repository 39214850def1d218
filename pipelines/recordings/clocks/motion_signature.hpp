// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace mtstereo::run {

/// What changes in a view over time, in numbers that both views of a scene share: they are sums
/// over whole rows, so they do not depend on disparities.
///
/// Of each pair of successive frames: the changes of the brightness of bands of rows relative to
/// the mean of all bands, and the mean flow in wider bands along x and y. A factor of the exposure
/// changes none of them.
struct MotionSignature {
  static constexpr int kBands = 18;     ///< of the brightness
  static constexpr int kFlowBands = 9;  ///< of the flow
  static constexpr int kFeatures = kBands + 2 * kFlowBands;

  std::vector<double> times;  ///< the middles between the frames [s]
  cv::Mat features;           ///< CV_32F: one row per time, kFeatures columns [1/s]
  /// How much the image changes over half a second, and from frame to frame: root mean squares of
  /// the differences of blocks [gray values].
  double slow_change = 0, fast_change = 0;

  /// Nothing moves: the changes over a longer time are not larger than the noise.
  bool is_static() const;
};

/// Makes the signature of successive frames.
class SignatureMaker {
 public:
  /// Adds a gray frame; all frames have the same size, at least 36 rows. Times increase [s].
  void add(const cv::Mat& frame, double time);
  /// The signature of all frames.
  MotionSignature take();

 private:
  void add_changes(const cv::Mat& blocks, double time);

  MotionSignature signature_;
  cv::Mat smooth_;                                  // the last frame
  std::vector<double> bands_;                       // of the last frame
  double time_ = 0;                                 // of the last frame
  std::vector<std::pair<double, cv::Mat>> blocks_;  // the frames of the last half second
  double slow_sum_ = 0, fast_sum_ = 0;
  int slow_count_ = 0, fast_count_ = 0;
};

}  // namespace mtstereo::run
