// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

#include <cstdint>
#include <optional>
#include <string>

#include "mtstereo/geometry/point_cloud.hpp"
#include "shared/depth_range.hpp"
#include "shared/geometry_properties.hpp"

namespace mtstereo::plugin {

/// The values of the properties of mtcloud.
struct CloudProperties {
  std::string location;
  gint format_choice = 0;  ///< 0: by the extension, otherwise a CloudFormat + 1
  int every_nth = 1;
  DepthRange range;
  int min_confidence = 0;
  int step = 1;
  std::uint64_t timeout = 5 * GST_SECOND;  ///< [ns]
  GeometryProperties geometry;

  /// std::nullopt: by the extension.
  std::optional<CloudFormat> format() const;
};

void install_cloud_properties(GObjectClass* object_class);

/// Sets a property; false if there is none of this number. The caller holds the lock.
bool set_cloud_property(CloudProperties& properties, guint id, const GValue* value);

/// Reads a property; false if there is none of this number. The caller holds the lock.
bool get_cloud_property(const CloudProperties& properties, guint id, GValue* value);

}  // namespace mtstereo::plugin
