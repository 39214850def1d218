// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "mtstereo/parameters.hpp"

namespace mtstereo::eval {

/// The filters that the library ends with, for the maps of matchers that come without them.
struct FilterSettings {
  int speckle_size = 0;          ///< components of fewer pixels are removed
  double speckle_tolerance = 1;  ///< 4-neighbors that differ by at most this are connected [px]
  int support_radius = 4;        ///< half the side of the window that confidence is told from [px]
  double support_tolerance = 1;  ///< disparities in it agree that differ by at most this [px] ...
  double support_slope = 13.0 / 32;  ///< ... and this more for each column or row between them [px]
};

/// Those of the library with these parameters.
FilterSettings filter_settings(const Parameters& parameters);

/// The settings in one line, for the report.
std::string text_of(const FilterSettings& settings);

/// A disparity map (CV_32FC1 [px] in steps of 1/16 px, NaN = none) without its small components.
cv::Mat remove_speckles(const cv::Mat& disparity, const FilterSettings& settings);

/// The confidence of each disparity (CV_8UC1), 0 where there is none: 255 times the share of the
/// pixels around it, within the image, whose disparities agree with it; at least 1. It is the
/// library's where no matching costs are known, that is with a peak ratio of 1.
cv::Mat support_confidence(const cv::Mat& disparity, const FilterSettings& settings);

}  // namespace mtstereo::eval
