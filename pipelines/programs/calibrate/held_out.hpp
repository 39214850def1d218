// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "mtstereo/geometry/rectification.hpp"
#include "programs/calibrate/bundle.hpp"

// How well a calibration fits views that it was not made from.

namespace mtstereo::calibrate {

/// Every n-th view is held out.
inline constexpr std::size_t kHoldOutStep = 5;
/// With fewer views, none is held out.
inline constexpr std::size_t kFewestForHoldOut = 10;

/// A part of the views that a calibration is made from, and the rest.
struct Division {
  std::vector<BoardView> used;
  std::vector<BoardView> held_out;
};

/// Holds out every fifth view, or none if there are too few.
Division divide(const std::vector<BoardView>& views);

/// The fit of views.
struct Fit {
  int views = 0;
  std::vector<double> rows;       ///< |row in the left view - row in the right one| after
                                  ///< rectification, of each corner that both see [px]
  std::vector<double> distances;  ///< from the corners to the projected board, whose pose is
                                  ///< fitted to each view [px]
};

/// Measures the fit of a rig to views.
Fit fit_of(const Rig& rig, const Rectification& rectification, std::vector<BoardView> views);

/// The value that this part of the values is below; 0 without values.
double quantile(std::vector<double> values, double part);

/// The position of a pixel after rectification [px]; std::nullopt if it is beside the image plane.
std::optional<Eigen::Vector2d> rectified(const Camera& camera, const Matrix3& rotation,
                                         double focal_length, double center_x, double center_y,
                                         const Eigen::Vector2d& pixel);

}  // namespace mtstereo::calibrate
