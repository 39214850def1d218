// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace mtstereo::tests {

/// Thin structures: posts, wires, bars. A pixel belongs to one if its true disparity is more than
/// kThinStep above the background on both sides, and the structure is at most kMostThin wide there,
/// along the row or along the column.
inline constexpr double kThinStep = 3;  ///< [px]
inline constexpr int kMostThin = 12;    ///< [px]

/// Distance from a thin structure up to which the background is its rim [px].
inline constexpr int kThinRim = 5;

/// What a disparity map has at thin structures and around them. Numbers of pixels.
struct ThinCounts {
  std::int64_t thin = 0;       ///< pixels of thin structures
  std::int64_t found = 0;      ///< of these, within 10 % of the truth
  std::int64_t painted = 0;    ///< of these, with the disparity of the background
  std::int64_t rim = 0;        ///< background within kThinRim px of a thin structure
  std::int64_t false_rim = 0;  ///< of this, more than 1 px too near
  std::int64_t far = 0;        ///< other background
  std::int64_t false_far = 0;  ///< of this, more than 1 px too near

  double recall() const;        ///< found / thin [%]
  double painted_over() const;  ///< painted / thin [%]
  double rim_share() const;     ///< false_rim / rim [%]
  double far_share() const;     ///< false_far / far [%]
};

/// Adds the numbers of another map.
ThinCounts& operator+=(ThinCounts& sum, const ThinCounts& counts);

/// The background of each pixel (CV_32FC1 [px]): the truth without thin structures. Pixels without
/// truth (NaN) limit nothing and have none.
cv::Mat background_of(const cv::Mat& truth);

/// Compares an estimate with the truth (both CV_32FC1 [px], NaN = none). Throws UserError if the
/// sizes differ.
ThinCounts measure_thin(const cv::Mat& estimate, const cv::Mat& truth);

}  // namespace mtstereo::tests
