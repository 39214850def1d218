// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <memory>

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

  /// True if all values are equal.
  friend bool operator==(const DepthGeometry&, const DepthGeometry&) = default;
};

/// How depths are written as 16-bit values.
struct DepthOptions {
  double unit = 0.001;                                   ///< length of the value 1 [m]
  double near = 0;                                       ///< smaller depths are left out [m]
  double far = std::numeric_limits<double>::infinity();  ///< greater depths are left out [m]
  /// A depth that does not fit into 16 bits, or is infinite, becomes 65535 if true, and none (0)
  /// otherwise.
  bool clamp = false;

  /// True if all values are equal.
  friend bool operator==(const DepthOptions&, const DepthOptions&) = default;
};

/// Checks that all values are finite, and those that must be are positive. Fails with
/// kInvalidCalibration.
MTSTEREO_API Status check_geometry(const DepthGeometry& geometry) noexcept;

/// Turns disparity maps into 16-bit depth maps. It holds the depth of each of the 65536 values, so
/// that a map costs one look-up per pixel. Made once for a geometry; convert() may be called by
/// several threads at a time.
class MTSTEREO_API DepthConverter {
 public:
  /// Computes the depths. Fails with kInvalidCalibration (see check_geometry()), or with
  /// kInvalidParameter if the unit is not positive or the range is empty.
  static Result<DepthConverter> create(const DepthGeometry& geometry,
                                       const DepthOptions& options = {}) noexcept;
  ~DepthConverter();
  /// Moves the table.
  DepthConverter(DepthConverter&&) noexcept;
  /// Moves the table.
  DepthConverter& operator=(DepthConverter&&) noexcept;

  /// The depth of a value of the map in units of DepthOptions::unit, rounded to the nearest (halves
  /// up); 0 = no depth. A depth of less than half a unit is 1, so that it differs from none.
  std::uint16_t depth16_of(std::uint16_t value) const noexcept;

  /// Writes depth16_of() for each pixel. `disparity` and `depth` may be the same image. Allocates
  /// nothing. Fails with kSizeMismatch or kInvalidImage.
  Status convert(ImageView<const std::uint16_t> disparity,
                 ImageView<std::uint16_t> depth) const noexcept;

 private:
  explicit DepthConverter(std::unique_ptr<std::uint16_t[]> table) noexcept;
  std::unique_ptr<std::uint16_t[]> table_;
};

}  // namespace mtstereo
