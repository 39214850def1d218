// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>

#include "programs/calibrate/solving.hpp"

namespace mtstereo::calibrate {

/// Standard deviations of what the views determine, if the errors of the corners are independent
/// of each other. A board that is not flat or a lens that differs from the model adds to them.
struct Uncertainty {
  double left_focal = 0;   ///< [px]
  double right_focal = 0;  ///< [px]
  double baseline = 0;     ///< [m]
};

/// std::nullopt if the views do not determine all parameters.
std::optional<Uncertainty> uncertainty_of(const Solution& solution);

/// The standard deviation of the depth of a point on the axis between the cameras at `depth` [m]
/// that comes from the calibration alone [m]. std::nullopt without a covariance, or if the point
/// is not visible.
std::optional<double> depth_uncertainty(const Solution& solution, double depth);

}  // namespace mtstereo::calibrate
