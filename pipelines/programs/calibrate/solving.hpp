// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "programs/calibrate/bundle.hpp"

namespace mtstereo::calibrate {

/// Fewer pairs of views do not determine two cameras.
inline constexpr std::size_t kFewestViews = 5;

/// Two calibrated cameras.
struct Solution {
  Rig rig;
  std::vector<BoardView> views;      ///< with their poses; corners that do not fit have weight 0
  std::vector<std::size_t> indices;  ///< of `views` in the views that were given
  std::vector<std::size_t> removed;  ///< indices of views that do not fit the others
  std::size_t removed_corners = 0;   ///< in `views`
  BundleOptions options;             ///< of the last adjustment, for its covariance
  BundleResult result;               ///< of the last adjustment
};

/// Calibrates both cameras together. Corners and views that do not fit are removed: a robust
/// adjustment finds them, and least squares of the others is the result. Throws UserError
/// if there are too few views, or no model fits them.
Solution solve(Model model, cv::Size left, cv::Size right, const std::vector<BoardView>& views);

}  // namespace mtstereo::calibrate
