// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mtstereo/geometry/depth.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "base/guard.hpp"

namespace mtstereo {

double DepthGeometry::depth_of(std::uint16_t value) const noexcept {
  const double disparity = value / scale + offset + principal_offset;
  if (value == 0 || disparity <= 0) return std::numeric_limits<double>::infinity();
  return focal_length * baseline / disparity;
}

double DepthGeometry::depth_step(double depth, double step) const noexcept {
  return depth * depth * step / (focal_length * baseline);
}

}  // namespace mtstereo
