// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "mtstereo/export.hpp"
#include "mtstereo/geometry/rectification.hpp"

// What a rectified pair of cameras can measure, for messages and reports.

namespace mtstereo {

/// The disparities that are searched.
struct DisparityRange {
  double smallest = 0;  ///< [px]
  double largest = 0;   ///< [px]; 0 = not known
  /// The smallest disparity that is told apart from infinity [px].
  double step = 1;
};

/// The figures of a rectified pair.
struct RigFigures {
  double focal_length = 0;      ///< of the rectified views [px]
  double baseline = 0;          ///< [m]
  double horizontal_field = 0;  ///< of view of the rectified left view [degrees]
  double vertical_field = 0;    ///< of view of the rectified left view [degrees]
  double nearest = 0;           ///< depth at the largest disparity [m]; 0 if that is not known
  /// Depth at the smallest disparity, at least DisparityRange::step from infinity [m].
  double farthest = 0;
  DisparityRange range;  ///< that nearest and farthest belong to
};

/// The figures of a rectification, as rectify() returns it. A rectification without a size has no
/// fields of view: they are 0.
MTSTEREO_API RigFigures rig_figures(const Rectification& rectification,
                                    const DisparityRange& range = {}) noexcept;

/// The figures as a sentence, such as "focal length 721.5 px, baseline 0.537 m, field of view 81 x
/// 29 degrees, measures from 3.03 m (128 px) to 388 m (1 px)".
MTSTEREO_API std::string rig_text(const RigFigures& figures);

}  // namespace mtstereo
