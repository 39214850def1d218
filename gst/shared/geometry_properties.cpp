// SPDX-License-Identifier: LGPL-2.1-or-later
#include "shared/geometry_properties.hpp"

#include <utility>

#include "mtstereo/geometry/calibration.hpp"

namespace mtstereo::plugin {
namespace {

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

}  // namespace

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
