// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

#include <optional>
#include <string>

#include "mtstereo/geometry/point_cloud.hpp"
#include "shared/depth_range.hpp"
#include "shared/geometry_properties.hpp"

namespace mtstereo::plugin {

/// The property `format`.
enum class CloudFormatChoice { kAuto, kPly, kPcd };

/// The values of the properties of mtcloud.
struct CloudProperties {
  std::string location;
  CloudFormatChoice format_choice = CloudFormatChoice::kAuto;
  int every_nth = 1;
  DepthRange range;
  int min_confidence = 0;
  int step = 1;
  guint64 timeout = 5 * GST_SECOND;  ///< [ns]
  GeometryProperties geometry;

  /// std::nullopt: by the extension.
  std::optional<CloudFormat> format() const;
};

const PropertyTable<CloudProperties>& cloud_properties();

}  // namespace mtstereo::plugin
