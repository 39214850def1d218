// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cloud/cloud_properties.hpp"

namespace mtstereo::plugin {
namespace {

enum Property : guint {
  kLocation = 1,
  kFormat,
  kEveryNth,
  kNear,
  kFar,
  kMinConfidence,
  kStep,
  kTimeout,
  kFirstGeometry,
};

enum FormatChoice : gint { kAuto, kPly, kPcd };

GType format_type() {
  static const GEnumValue values[] = {{kAuto, "By the extension of the location", "auto"},
                                      {kPly, "PLY, binary", "ply"},
                                      {kPcd, "PCD of the Point Cloud Library, binary", "pcd"},
                                      {0, nullptr, nullptr}};
  static const GType type = g_enum_register_static("GstMtStereoCloudFormat", values);
  return type;
}

constexpr auto kFlags = static_cast<GParamFlags>(G_PARAM_READWRITE | G_PARAM_STATIC_STRINGS |
                                                 GST_PARAM_MUTABLE_PLAYING);
constexpr auto kReadyFlags =
    static_cast<GParamFlags>(G_PARAM_READWRITE | G_PARAM_STATIC_STRINGS | GST_PARAM_MUTABLE_READY);

void install_file_properties(GObjectClass* object_class) {
  g_object_class_install_property(
      object_class, kLocation,
      g_param_spec_string("location", "location",
                          "Path of the files, with a number such as %05d for the number of the "
                          "disparity map, from 0; without one each file replaces the one before",
                          nullptr, kReadyFlags));
  g_object_class_install_property(object_class, kFormat,
                                  g_param_spec_enum("format", "format", "Format of the files",
                                                    format_type(), kAuto, kReadyFlags));
  g_object_class_install_property(
      object_class, kEveryNth,
      g_param_spec_int("every-nth", "every-nth",
                       "Every n-th disparity map is written, from the first one", 1, G_MAXINT, 1,
                       kFlags));
  g_object_class_install_property(
      object_class, kTimeout,
      g_param_spec_uint64("timeout", "timeout",
                          "Longest wait for a frame of the left view or for a disparity map, in "
                          "ns; then the points are white, or the oldest left frame is dropped",
                          0, 3600 * GST_SECOND, 5 * GST_SECOND, kReadyFlags));
}

void install_point_properties(GObjectClass* object_class) {
  g_object_class_install_property(
      object_class, kNear,
      g_param_spec_double("near", "near", "Nearer points are left out, in meters", 0,
                          kLargestDepthLimit, 0, kFlags));
  g_object_class_install_property(
      object_class, kFar,
      g_param_spec_double("far", "far", "Farther points are left out, in meters (0: no limit)", 0,
                          kLargestDepthLimit, 0, kFlags));
  g_object_class_install_property(
      object_class, kMinConfidence,
      g_param_spec_int("min-confidence", "min-confidence",
                       "Points of lower confidence are left out (0: all are written)", 0, 255, 0,
                       kFlags));
  g_object_class_install_property(
      object_class, kStep,
      g_param_spec_int("step", "step", "Points of every n-th pixel of every n-th row", 1, 16384, 1,
                       kFlags));
}

}  // namespace

std::optional<CloudFormat> CloudProperties::format() const {
  switch (format_choice) {
    case kPly:
      return CloudFormat::kPly;
    case kPcd:
      return CloudFormat::kPcd;
    default:
      return std::nullopt;
  }
}

void install_cloud_properties(GObjectClass* object_class) {
  install_file_properties(object_class);
  install_point_properties(object_class);
  install_geometry_properties(object_class, kFirstGeometry);
  gst_type_mark_as_plugin_api(format_type(), static_cast<GstPluginAPIFlags>(0));
}

bool set_cloud_property(CloudProperties& properties, guint id, const GValue* value) {
  switch (id) {
    case kLocation: {
      const gchar* text = g_value_get_string(value);
      properties.location = text != nullptr ? text : "";
      return true;
    }
    case kFormat:
      properties.format_choice = g_value_get_enum(value);
      return true;
    case kEveryNth:
      properties.every_nth = g_value_get_int(value);
      return true;
    case kNear:
      properties.range.near = g_value_get_double(value);
      return true;
    case kFar:
      properties.range.far = g_value_get_double(value);
      return true;
    case kMinConfidence:
      properties.min_confidence = g_value_get_int(value);
      return true;
    case kStep:
      properties.step = g_value_get_int(value);
      return true;
    case kTimeout:
      properties.timeout = g_value_get_uint64(value);
      return true;
    default:
      return set_geometry_property(properties.geometry, id - kFirstGeometry, value);
  }
}

bool get_cloud_property(const CloudProperties& properties, guint id, GValue* value) {
  switch (id) {
    case kLocation:
      g_value_set_string(value,
                         properties.location.empty() ? nullptr : properties.location.c_str());
      return true;
    case kFormat:
      g_value_set_enum(value, properties.format_choice);
      return true;
    case kEveryNth:
      g_value_set_int(value, properties.every_nth);
      return true;
    case kNear:
      g_value_set_double(value, properties.range.near);
      return true;
    case kFar:
      g_value_set_double(value, properties.range.far);
      return true;
    case kMinConfidence:
      g_value_set_int(value, properties.min_confidence);
      return true;
    case kStep:
      g_value_set_int(value, properties.step);
      return true;
    case kTimeout:
      g_value_set_uint64(value, properties.timeout);
      return true;
    default:
      return get_geometry_property(properties.geometry, id - kFirstGeometry, value);
  }
}

}  // namespace mtstereo::plugin
