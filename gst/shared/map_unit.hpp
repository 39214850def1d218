// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

#include <optional>

#include "mtstereo/result.hpp"

// What the values of a 16-bit map mean: disparities or depths, and their unit.

namespace mtstereo::plugin {

/// The field of caps that marks a map of depths: depth [m] = value * depth-unit, 0 = no depth. The
/// value is a double. Maps without it are disparities. It is part of the public interface.
inline constexpr const char* kDepthUnitField = "depth-unit";

/// The unit of disparities: disparity [px] = value / scale + offset.
struct MapUnit {
  int scale = 0;   ///< [steps per px], 1 .. 65535
  int offset = 0;  ///< [px], -65535 .. 0
  bool operator==(const MapUnit&) const = default;
};

/// The unit of disparities in the fields of caps; std::nullopt if they have none. An error if the
/// values are not valid, or if the maps are depths.
Result<std::optional<MapUnit>> disparity_unit_in(const GstStructure* fields);

/// The unit of a disparity map: from the caps, the meta of the buffer, or the property
/// disparity-scale.
MapUnit map_unit(const std::optional<MapUnit>& caps, GstBuffer* map, int property);

/// The unit of depths [m] in the fields of caps; std::nullopt if they have none, or one that is not
/// positive and finite.
std::optional<double> depth_unit_in(const GstStructure* fields);

/// Removes the fields that define the meaning of the values of a map.
void remove_map_unit(GstStructure* fields);

}  // namespace mtstereo::plugin
