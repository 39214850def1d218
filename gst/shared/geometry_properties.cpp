// SPDX-License-Identifier: LGPL-2.1-or-later
#include "shared/geometry_properties.hpp"

#include <utility>

#include "mtstereo/geometry/calibration.hpp"
#include "mtstereo/geometry/rectification.hpp"

namespace mtstereo::plugin {
namespace {

enum Index : guint {
  kFocalLength,
  kBaseline,
  kPrincipalOffset,
  kPrincipalX,
  kPrincipalY,
  kCalibration,
  kDisparityScale,
};
static_assert(kDisparityScale + 1 == kGeometryPropertyCount);

constexpr double kLargestFocalLength = 1e6;  // [px]
constexpr double kLargestOffset = 1e5;       // [px]

constexpr auto kFlags = static_cast<GParamFlags>(G_PARAM_READWRITE | G_PARAM_STATIC_STRINGS |
                                                 GST_PARAM_MUTABLE_PLAYING);

std::string text_of(const GValue* value) {
  const gchar* text = g_value_get_string(value);
  return text != nullptr ? text : "";
}

/// The geometry of the views after the rectification that mtrectify computes without properties, or
/// that the file states.
Result<StereoGeometry> read_file(const std::string& path, int width, int height,
                                 std::vector<std::string>& remarks) {
  Result<StereoCalibration> calibration = read_calibration(path, width, height);
  if (!calibration) return calibration.error();
  if (calibration->left.width != width || calibration->left.height != height) {
    calibration = scale_calibration(*calibration, width, height);
    if (!calibration) return calibration.error();
  }
  remarks = calibration->remarks;
  const Result<Rectification> rectified = rectify(*calibration);
  if (!rectified) return rectified.error();
  if (rectified->width != width || rectified->height != height) {
    return Error{ErrorCode::kInvalidCalibration,
                 path + " describes rectified views of " + std::to_string(rectified->width) + "x" +
                     std::to_string(rectified->height) + " px, the disparity map has " +
                     std::to_string(width) + "x" + std::to_string(height) + " px"};
  }
  StereoGeometry geometry;
  geometry.focal_length = rectified->focal_length;
  geometry.baseline = rectified->baseline;
  geometry.principal_offset = rectified->principal_offset();
  geometry.principal_x = rectified->left_center_x;
  geometry.principal_y = rectified->center_y;
  return geometry;
}

Error missing(const GeometryProperties& properties) {
  const char* what = properties.focal_length > 0 ? "the baseline of the cameras is"
                     : properties.baseline > 0   ? "the focal length of the cameras is"
                                                 : "the focal length and the baseline are";
  return {ErrorCode::kInvalidCalibration,
          std::string(what) +
              " not known: the caps have no geometry. Put mtrectify upstream of mtstereo, which "
              "puts the geometry into the caps; or set calibration=FILE, the file that the views "
              "were rectified with; or set focal-length=PX and baseline=METERS"};
}

void install_double(GObjectClass* object_class, guint id, const char* name, const char* blurb,
                    double least, double largest) {
  g_object_class_install_property(
      object_class, id, g_param_spec_double(name, name, blurb, least, largest, 0, kFlags));
}

}  // namespace

void install_geometry_properties(GObjectClass* object_class, guint first) {
  install_double(object_class, first + kFocalLength, "focal-length",
                 "Focal length of the rectified views, in px (0: that of the calibration or of the "
                 "caps, which mtrectify sets)",
                 0, kLargestFocalLength);
  install_double(object_class, first + kBaseline, "baseline",
                 "Distance of the cameras, in meters (0: that of the calibration or of the caps)",
                 0, kLongestBaseline);
  install_double(object_class, first + kPrincipalOffset, "principal-offset",
                 "Column of the principal point of the right view minus that of the left view, in "
                 "px; it is added to the disparities (not set: that of the calibration or of the "
                 "caps, or 0)",
                 -kLargestOffset, kLargestOffset);
  install_double(object_class, first + kPrincipalX, "principal-x",
                 "Column of the principal point of the left view, in px (not set: that of the "
                 "calibration or of the caps, or the center)",
                 -kLargestOffset, kLargestOffset);
  install_double(object_class, first + kPrincipalY, "principal-y",
                 "Row of the principal point of the left view, in px (not set: that of the "
                 "calibration or of the caps, or the center)",
                 -kLargestOffset, kLargestOffset);
  g_object_class_install_property(
      object_class, first + kCalibration,
      g_param_spec_string("calibration", "calibration",
                          "File with the calibration of the cameras, if the caps do not have the "
                          "geometry: the views were rectified by it and the defaults of "
                          "mtrectify, or by the rectification that it states; two files are "
                          "separated by a comma",
                          nullptr, kFlags));
  g_object_class_install_property(
      object_class, first + kDisparityScale,
      g_param_spec_int("disparity-scale", "disparity-scale",
                       "Steps per px of the input if neither its caps nor its meta have a "
                       "disparity-scale, for example downstream of a decoder; these take "
                       "precedence",
                       1, 65535, 256, kFlags));
}

bool set_geometry_property(GeometryProperties& properties, guint index, const GValue* value) {
  switch (index) {
    case kFocalLength:
      properties.focal_length = g_value_get_double(value);
      return true;
    case kBaseline:
      properties.baseline = g_value_get_double(value);
      return true;
    case kPrincipalOffset:
      properties.principal_offset = g_value_get_double(value);
      return true;
    case kPrincipalX:
      properties.principal_x = g_value_get_double(value);
      return true;
    case kPrincipalY:
      properties.principal_y = g_value_get_double(value);
      return true;
    case kCalibration:
      properties.calibration = text_of(value);
      return true;
    case kDisparityScale:
      properties.disparity_scale = g_value_get_int(value);
      return true;
    default:
      return false;
  }
}

bool get_geometry_property(const GeometryProperties& properties, guint index, GValue* value) {
  switch (index) {
    case kFocalLength:
      g_value_set_double(value, properties.focal_length);
      return true;
    case kBaseline:
      g_value_set_double(value, properties.baseline);
      return true;
    case kPrincipalOffset:
      g_value_set_double(value, properties.principal_offset.value_or(0));
      return true;
    case kPrincipalX:
      g_value_set_double(value, properties.principal_x.value_or(0));
      return true;
    case kPrincipalY:
      g_value_set_double(value, properties.principal_y.value_or(0));
      return true;
    case kCalibration:
      g_value_set_string(value,
                         properties.calibration.empty() ? nullptr : properties.calibration.c_str());
      return true;
    case kDisparityScale:
      g_value_set_int(value, properties.disparity_scale);
      return true;
    default:
      return false;
  }
}

Result<StereoGeometry> GeometrySource::from_file(const std::string& path, int width, int height) {
  const std::lock_guard lock(mutex_);
  const bool known =
      file_ && file_->path == path && file_->width == width && file_->height == height;
  if (!known) {
    std::vector<std::string> remarks;
    Result<StereoGeometry> geometry = read_file(path, width, height, remarks);
    file_.emplace(File{path, width, height, std::move(geometry), std::move(remarks)});
  }
  return file_->geometry;
}

void GeometrySource::forget() {
  const std::lock_guard lock(mutex_);
  file_.reset();
}

std::vector<std::string> GeometrySource::remarks() {
  const std::lock_guard lock(mutex_);
  return file_ ? file_->remarks : std::vector<std::string>{};
}

Result<StereoGeometry> GeometrySource::geometry(const GstStructure* fields,
                                                const GeometryProperties& properties) {
  int width = 0;
  int height = 0;
  gst_structure_get_int(fields, "width", &width);
  gst_structure_get_int(fields, "height", &height);
  const std::optional<StereoGeometry> in_caps = read_geometry(fields);
  StereoGeometry geometry = in_caps.value_or(StereoGeometry{});
  if (!in_caps) {
    geometry.principal_x = (width - 1) / 2.0;
    geometry.principal_y = (height - 1) / 2.0;
  }
  if (!properties.calibration.empty()) {
    Result<StereoGeometry> file = from_file(properties.calibration, width, height);
    if (!file) return file;
    file->valid_region = geometry.valid_region;
    geometry = *file;
  }
  if (properties.focal_length > 0) geometry.focal_length = properties.focal_length;
  if (properties.baseline > 0) geometry.baseline = properties.baseline;
  geometry.principal_offset = properties.principal_offset.value_or(geometry.principal_offset);
  geometry.principal_x = properties.principal_x.value_or(geometry.principal_x);
  geometry.principal_y = properties.principal_y.value_or(geometry.principal_y);
  if (geometry.focal_length > 0 && geometry.baseline > 0) return geometry;
  return missing(properties);
}

DepthGeometry depth_geometry(const StereoGeometry& stream, const MapUnit& unit) {
  DepthGeometry geometry;
  geometry.focal_length = stream.focal_length;
  geometry.baseline = stream.baseline;
  geometry.principal_offset = stream.principal_offset;
  geometry.center_x = stream.principal_x;
  geometry.center_y = stream.principal_y;
  geometry.scale = unit.scale;
  geometry.offset = unit.offset;
  return geometry;
}

}  // namespace mtstereo::plugin
