// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <string>

#include "tools/eval/curve.hpp"
#include "tools/eval/datasets.hpp"
#include "tools/eval/map_filters.hpp"
#include "tools/eval/opencv_matchers.hpp"

namespace mtstereo::eval {

/// The values of uniquenessRatio in a sweep of OpenCV [%].
inline constexpr std::array<int, 20> kUniquenessRatios{0,  5,  10, 15, 20, 25, 30, 35, 40, 45,
                                                       50, 55, 60, 65, 70, 75, 80, 85, 90, 95};

/// The values in one line, for the report.
std::string uniqueness_ratios_text();

/// Runs a method of OpenCV once per uniqueness ratio, with the other settings of opencv_settings().
/// The first column has the unfiltered results, the others the filtered ones at the thresholds 1 ..
/// kMostConfidence. Throws UserError if OpenCV rejects the images.
Sweep sweep_opencv(OpenCvMethod method, int max_disparity, const LoadedPair& images,
                   const FilterSettings& filters);

}  // namespace mtstereo::eval
