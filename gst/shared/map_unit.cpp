// SPDX-License-Identifier: LGPL-2.1-or-later
#include "shared/map_unit.hpp"

#include <cmath>
#include <string>

#include "shared/disparity_meta.hpp"

namespace mtstereo::plugin {

Result<std::optional<MapUnit>> disparity_unit_in(const GstStructure* fields) {
  if (gst_structure_has_field(fields, kDepthUnitField)) {
    return Error{ErrorCode::kInvalidImage,
                 "the stream has depths, not disparities (its caps have a depth-unit): link the "
                 "element to the disparity map, upstream of mtdepth"};
  }
  MapUnit unit;
  if (!gst_structure_get_int(fields, kScaleField, &unit.scale)) return std::optional<MapUnit>();
  gst_structure_get_int(fields, kOffsetField, &unit.offset);
  if (unit.scale >= 1 && unit.scale <= 65535 && unit.offset <= 0 && unit.offset >= -65535) {
    return std::optional(unit);
  }
  return Error{ErrorCode::kInvalidImage,
               "the caps of the disparity map have disparity-scale=" + std::to_string(unit.scale) +
                   " and disparity-offset=" + std::to_string(unit.offset) +
                   "; the scale must be 1 to 65535 steps per px and the offset -65535 to 0 px: "
                   "correct them in the element that sets the caps"};
}

MapUnit map_unit(const std::optional<MapUnit>& caps, GstBuffer* map, int property) {
  if (caps) return *caps;
  if (const auto meta = disparity_unit_of(map)) return {meta->scale, meta->offset};
  return {property, 0};
}

std::optional<double> depth_unit_in(const GstStructure* fields) {
  double unit = 0;
  int whole = 0;
  if (gst_structure_get_int(fields, kDepthUnitField, &whole)) unit = whole;  // 1 on a command line
  gst_structure_get_double(fields, kDepthUnitField, &unit);
  return unit > 0 && std::isfinite(unit) ? std::optional(unit) : std::nullopt;
}

void remove_map_unit(GstStructure* fields) {
  gst_structure_remove_fields(fields, kScaleField, kMaxDisparityField, kMinDisparityField,
                              kOffsetField, kDepthUnitField, nullptr);
}

}  // namespace mtstereo::plugin
