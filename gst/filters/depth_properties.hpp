// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

#include "shared/depth_range.hpp"
#include "shared/geometry_properties.hpp"

namespace mtstereo::plugin {

/// The values of the properties of mtdepth.
struct DepthProperties {
  double unit = 1;  ///< [mm]
  DepthRange range;
  bool clamp = false;       ///< overflow=clamp
  bool free_space = false;  ///< pixels without a disparity get the depth of their bound
  GeometryProperties geometry;
};

void install_depth_properties(GObjectClass* object_class);

/// Sets a property; false if there is none of this number. The caller holds the lock.
bool set_depth_property(DepthProperties& properties, guint id, const GValue* value);

/// Reads a property; false if there is none of this number. The caller holds the lock.
bool get_depth_property(const DepthProperties& properties, guint id, GValue* value);

/// True if the caps of the output state the property.
bool is_in_depth_caps(guint id);

}  // namespace mtstereo::plugin
