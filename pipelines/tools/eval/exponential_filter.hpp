// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <utility>

namespace mtstereo::eval {

/// The filter over time that programs of depth cameras apply to the maps of any matcher, with their
/// usual settings: a mean that begins anew where a disparity changes by more than kDelta,
/// and keeps a disparity that is unknown now if it was known in two of the last four maps.
class ExponentialFilter {
 public:
  static constexpr float kAlpha = 0.4F;        ///< weight of the present map
  static constexpr float kDelta = 20.0F / 32;  ///< [px]

  /// The filtered map after the next map of a stream (CV_32FC1 [px], NaN = unknown). It begins anew
  /// with a map of another size.
  cv::Mat filtered(const cv::Mat& map);

 private:
  cv::Mat last_;     // the last disparity that was known
  cv::Mat history_;  // CV_8UC1: a bit for each of the last maps, 1 = known, the latest lowest
};

/// The name of a method's maps after the filter.
inline std::string filtered_name(std::string method) { return std::move(method) + "+filter"; }

}  // namespace mtstereo::eval
