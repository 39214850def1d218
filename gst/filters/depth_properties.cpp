// SPDX-License-Identifier: LGPL-2.1-or-later
#include "filters/depth_properties.hpp"

namespace mtstereo::plugin {
namespace {

enum Property : guint { kUnit = 1, kNear, kFar, kOverflow, kFreeSpace, kFirstGeometry };

enum Overflow : gint { kNone, kClamp };

GType overflow_type() {
  static const GEnumValue values[] = {
      {kNone, "Such pixels have no depth (0)", "none"},
      {kClamp, "Such pixels have the largest value (65535)", "clamp"},
      {0, nullptr, nullptr}};
  static const GType type = g_enum_register_static("GstMtStereoDepthOverflow", values);
  return type;
}

constexpr auto kFlags = static_cast<GParamFlags>(G_PARAM_READWRITE | G_PARAM_STATIC_STRINGS |
                                                 GST_PARAM_MUTABLE_PLAYING);

void install_range_properties(GObjectClass* object_class) {
  g_object_class_install_property(
      object_class, kNear,
      g_param_spec_double("near", "near", "Nearer pixels have no depth (0), in meters", 0,
                          kLargestDepthLimit, 0, kFlags));
  g_object_class_install_property(
      object_class, kFar,
      g_param_spec_double("far", "far", "Farther pixels have no depth (0), in meters (0: no limit)",
                          0, kLargestDepthLimit, 0, kFlags));
}

}  // namespace

void install_depth_properties(GObjectClass* object_class) {
  g_object_class_install_property(
      object_class, kUnit,
      g_param_spec_double("unit", "unit",
                          "Length of the value 1, in mm; the caps of the output state it in "
                          "meters, as depth-unit (1: depths up to 65.535 m)",
                          0.001, 1000, 1, kFlags));
  install_range_properties(object_class);
  g_object_class_install_property(
      object_class, kOverflow,
      g_param_spec_enum("overflow", "overflow",
                        "Depths that do not fit into 16 bits: more than 65535 units, or infinite",
                        overflow_type(), kNone, kFlags));
  g_object_class_install_property(
      object_class, kFreeSpace,
      g_param_spec_boolean("free-space", "free-space",
                           "Pixels without a disparity have the distance up to which their rays "
                           "are free, by the nearest disparities to the left, to the right, above "
                           "and below, if there are some to the left and right; not guaranteed "
                           "(false: no depth)",
                           FALSE, kFlags));
  gst_type_mark_as_plugin_api(overflow_type(), static_cast<GstPluginAPIFlags>(0));
  install_geometry_properties(object_class, kFirstGeometry);
}

bool set_depth_property(DepthProperties& properties, guint id, const GValue* value) {
  switch (id) {
    case kUnit:
      properties.unit = g_value_get_double(value);
      return true;
    case kNear:
      properties.range.near = g_value_get_double(value);
      return true;
    case kFar:
      properties.range.far = g_value_get_double(value);
      return true;
    case kOverflow:
      properties.clamp = g_value_get_enum(value) == kClamp;
      return true;
    case kFreeSpace:
      properties.free_space = g_value_get_boolean(value) != FALSE;
      return true;
    default:
      return set_geometry_property(properties.geometry, id - kFirstGeometry, value);
  }
}

bool get_depth_property(const DepthProperties& properties, guint id, GValue* value) {
  switch (id) {
    case kUnit:
      g_value_set_double(value, properties.unit);
      return true;
    case kNear:
      g_value_set_double(value, properties.range.near);
      return true;
    case kFar:
      g_value_set_double(value, properties.range.far);
      return true;
    case kOverflow:
      g_value_set_enum(value, properties.clamp ? kClamp : kNone);
      return true;
    case kFreeSpace:
      g_value_set_boolean(value, properties.free_space ? TRUE : FALSE);
      return true;
    default:
      return get_geometry_property(properties.geometry, id - kFirstGeometry, value);
  }
}

bool is_in_depth_caps(guint id) { return id == kUnit || id >= kFirstGeometry; }

}  // namespace mtstereo::plugin
