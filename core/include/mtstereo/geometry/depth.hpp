// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <limits>

#include "mtstereo/export.hpp"
#include "mtstereo/geometry/calibration.hpp"
#include "mtstereo/image.hpp"
#include "mtstereo/result.hpp"

// From disparities to depths and points.

namespace mtstereo {

/// What turns a disparity map of 16-bit values into depths: disparity [px] = value / scale +
/// offset, and depth [m] = focal_length * baseline / (disparity + principal_offset).
struct DepthGeometry {
  double focal_length = 0;      ///< [px]
  double baseline = 0;          ///< [m]
  double principal_offset = 0;  ///< Rectification::principal_offset() [px]
  double center_x = 0;          ///< column of the principal point of the left view [px]
  double center_y = 0;          ///< row of the principal point of the left view [px]
  double scale = 256;           ///< values per px of disparity
  double offset = 0;            ///< [px]

  /// The depth of a value of the map [m]: infinity for 0 (no disparity) and at or beyond infinity.
  MTSTEREO_API double depth_of(std::uint16_t value) const noexcept;
  /// How much the depth changes per `step` px of disparity at a depth [m].
  MTSTEREO_API double depth_step(double depth, double step) const noexcept;
};

/// How depths are written as 16-bit values.
struct DepthOptions {
  double unit = 0.001;                                   ///< length of the value 1 [m]
  double near = 0;                                       ///< smaller depths are left out [m]
  double far = std::numeric_limits<double>::infinity();  ///< greater depths are left out [m]
  /// A depth that does not fit into 16 bits becomes 65535 if true, and none (0) otherwise.
  bool clamp = false;
};

/// Checks that all values are finite, and those that must be are positive. Fails with
/// kInvalidCalibration.
MTSTEREO_API Status check_geometry(const DepthGeometry& geometry) noexcept;

/// Writes the depth of each pixel in units of `options.unit`, rounded to the nearest; 0 = no depth.
/// `disparity` and `depth` may be the same image. Fails with kSizeMismatch, kInvalidImage,
/// kInvalidCalibration or kInvalidParameter.
MTSTEREO_API Status write_depth16(ImageView<const std::uint16_t> disparity,
                                  const DepthGeometry& geometry, const DepthOptions& options,
                                  ImageView<std::uint16_t> depth) noexcept;

}  // namespace mtstereo
