// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

#include "shared/depth_range.hpp"
#include "shared/geometry_properties.hpp"

namespace mtstereo::plugin {

/// Depths that do not fit into 16 bits.
enum class DepthOverflow { kNone, kClamp };

/// The values of the properties of mtdepth.
struct DepthProperties {
  double unit = 1;  ///< [mm]
  DepthRange range;
  DepthOverflow overflow = DepthOverflow::kNone;
  bool free_space = false;  ///< pixels without a disparity get the depth of their bound
  GeometryProperties geometry;
};

const PropertyTable<DepthProperties>& depth_properties();

}  // namespace mtstereo::plugin
