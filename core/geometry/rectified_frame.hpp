// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>

#include "mtstereo/geometry/rectification.hpp"

namespace mtstereo {

/// What part of the scene the rectified images show.
struct RectifiedFrame {
  double focal_length = 0;    ///< [px]
  double left_center_x = 0;   ///< [px]
  double right_center_x = 0;  ///< [px]
  double center_y = 0;        ///< [px]

  bool is_usable() const {
    return std::isfinite(focal_length) && focal_length > 0 && std::isfinite(left_center_x) &&
           std::isfinite(right_center_x) && std::isfinite(center_y);
  }
};

/// Why views are refused that show nothing of what the other one shows.
inline constexpr const char* kNoCommonPart =
    "the cameras see no common part of the scene in the rectified images. The rotation or the lens "
    "coefficients are wrong, or the cameras look in different directions";

/// Chooses the frame of views whose rotations and size are known, for any lens: the borders of both
/// images are projected to the rectified plane. With alpha = 0 the images are as large as fits into
/// both, with alpha = 1 both fit into the images. What the lens model does not cover is left out,
/// and so are directions that are too far from the axis for a plane. Fails with
/// kInvalidCalibration.
Result<RectifiedFrame> frame_views(const StereoCalibration& calibration,
                                   const Rectification& rotations,
                                   const RectificationOptions& options);

}  // namespace mtstereo
