// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "mtstereo/parameters.hpp"

namespace mtstereo::eval {

/// The last filters of the library, for the maps of other matchers.
struct FilterSettings {
  int speckle_size = 0;              ///< components of fewer pixels are removed
  double speckle_tolerance = 1;      ///< largest difference of connected 4-neighbors [px]
  int support_radius = 4;            ///< radius of the window that determines confidence [px]
  double support_tolerance = 1;      ///< largest difference of agreeing disparities in it [px] ...
  double support_slope = 13.0 / 32;  ///< ... plus this per column or row of distance [px]
};

/// The settings of the library with these parameters.
FilterSettings filter_settings(const Parameters& parameters);

/// The settings in one line, for the report.
std::string text_of(const FilterSettings& settings);

/// A disparity map (CV_32FC1 [px] in steps of 1/16 px, NaN = none) without its small components.
cv::Mat remove_speckles(const cv::Mat& disparity, const FilterSettings& settings);

/// The confidence of each disparity (CV_8UC1): 255 times the share of the surrounding pixels inside
/// the image whose disparities agree with it, at least 1; 0 = no disparity. It equals the library's
/// confidence without matching costs, that is, with a peak ratio of 1.
cv::Mat support_confidence(const cv::Mat& disparity, const FilterSettings& settings);

}  // namespace mtstereo::eval
