// SPDX-License-Identifier: LGPL-2.1-or-later
#include "shared/stereo_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace mtstereo::plugin {
namespace {

std::optional<double> number(const GstStructure* fields, const char* name) {
  double value = 0;
  if (gst_structure_get_double(fields, name, &value) == FALSE || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

// A number that caps filters on a command line often write as an integer, such as 700.
std::optional<double> any_number(const GstStructure* fields, const char* name) {
  int integer = 0;
  if (gst_structure_get_int(fields, name, &integer) == TRUE) return integer;
  return number(fields, name);
}

std::optional<PixelRectangle> rectangle(const GstStructure* fields) {
  const GValue* list = gst_structure_get_value(fields, kValidRegionField);
  if (list == nullptr || !GST_VALUE_HOLDS_ARRAY(list) || gst_value_array_get_size(list) != 4) {
    return std::nullopt;
  }
  int values[4] = {};
  for (guint i = 0; i < 4; ++i) {
    const GValue* value = gst_value_array_get_value(list, i);
    if (!G_VALUE_HOLDS_INT(value)) return std::nullopt;
    values[i] = g_value_get_int(value);
    if (values[i] < 0) return std::nullopt;
  }
  return PixelRectangle{values[0], values[1], values[2], values[3]};
}

double center_of(const GstStructure* fields, const char* size) {
  int length = 1;
  gst_structure_get_int(fields, size, &length);
  return (length - 1) / 2.0;
}

}  // namespace

std::optional<StereoGeometry> read_geometry(const GstStructure* fields) {
  const std::optional<double> focal = any_number(fields, kFocalLengthField);
  const std::optional<double> baseline = any_number(fields, kBaselineField);
  if (!focal || !baseline || *focal <= 0 || *baseline <= 0) return std::nullopt;
  StereoGeometry geometry;
  geometry.focal_length = *focal;
  geometry.baseline = *baseline;
  geometry.principal_offset = any_number(fields, kPrincipalOffsetField).value_or(0);
  geometry.principal_x = any_number(fields, kPrincipalXField).value_or(center_of(fields, "width"));
  geometry.principal_y = any_number(fields, kPrincipalYField).value_or(center_of(fields, "height"));
  geometry.valid_region = rectangle(fields);
  return geometry;
}

bool same_rectification(const StereoGeometry& first, const StereoGeometry& second) {
  constexpr double kRounding = 1e-6;
  const auto equal = [](double a, double b) {
    return std::abs(a - b) <= kRounding * std::max({std::abs(a), std::abs(b), 1.0});
  };
  return equal(first.focal_length, second.focal_length) &&
         std::abs(first.baseline - second.baseline) <= kRounding * first.baseline &&
         equal(first.principal_offset, second.principal_offset);
}

std::string larger_frame(const StereoGeometry& geometry, int width, int height) {
  const PixelRectangle region = geometry.valid_region.value_or(PixelRectangle{});
  const auto right = std::int64_t{region.x} + region.width;
  const auto bottom = std::int64_t{region.y} + region.height;
  if (right <= width && bottom <= height) return {};
  return "video of " + std::to_string(width) + "x" + std::to_string(height) +
         ", valid-region up to " + std::to_string(right) + "x" + std::to_string(bottom);
}

void write_geometry(GstStructure* fields, const StereoGeometry& geometry) {
  gst_structure_set(fields, kFocalLengthField, G_TYPE_DOUBLE, geometry.focal_length, kBaselineField,
                    G_TYPE_DOUBLE, geometry.baseline, kPrincipalOffsetField, G_TYPE_DOUBLE,
                    geometry.principal_offset, kPrincipalXField, G_TYPE_DOUBLE,
                    geometry.principal_x, kPrincipalYField, G_TYPE_DOUBLE, geometry.principal_y,
                    nullptr);
  if (!geometry.valid_region) {
    gst_structure_remove_field(fields, kValidRegionField);
    return;
  }
  const PixelRectangle& region = *geometry.valid_region;
  GValue list = G_VALUE_INIT;
  g_value_init(&list, GST_TYPE_ARRAY);
  for (const int value : {region.x, region.y, region.width, region.height}) {
    GValue item = G_VALUE_INIT;
    g_value_init(&item, G_TYPE_INT);
    g_value_set_int(&item, value);
    gst_value_array_append_and_take_value(&list, &item);
  }
  gst_structure_take_value(fields, kValidRegionField, &list);
}

void copy_geometry_fields(const GstStructure* from, GstStructure* to) {
  for (const char* field : kGeometryFields) {
    const GValue* value = gst_structure_get_value(from, field);
    if (value != nullptr) {
      gst_structure_set_value(to, field, value);
    } else {
      gst_structure_remove_field(to, field);
    }
  }
}

}  // namespace mtstereo::plugin
