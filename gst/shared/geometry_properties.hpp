// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "mtstereo/geometry/depth.hpp"
#include "mtstereo/result.hpp"
#include "shared/map_unit.hpp"
#include "shared/stereo_geometry.hpp"

// The properties of elements that turn disparities into depths: mtdepth and mtcloud.

namespace mtstereo::plugin {

/// The values of the properties. What is not set comes from the calibration file, and without one
/// from the caps.
struct GeometryProperties {
  double focal_length = 0;                 ///< [px]; 0: not set
  double baseline = 0;                     ///< [m]; 0: not set
  std::optional<double> principal_offset;  ///< [px]
  std::optional<double> principal_x;       ///< [px]
  std::optional<double> principal_y;       ///< [px]
  std::string calibration;                 ///< path of a file; empty: not set
  int disparity_scale = 256;               ///< [steps per px], for maps that do not state their own
};

/// The number of properties.
inline constexpr guint kGeometryPropertyCount = 7;

/// Installs the properties under the numbers `first` to `first` + kGeometryPropertyCount - 1.
void install_geometry_properties(GObjectClass* object_class, guint first);

/// Sets the property `index`, counted from 0; false if there is none. The caller holds the lock.
bool set_geometry_property(GeometryProperties& properties, guint index, const GValue* value);

/// Reads the property `index`; false if there is none. The caller holds the lock.
bool get_geometry_property(const GeometryProperties& properties, guint index, GValue* value);

/// Finds the geometry of a stream. It keeps the content of the calibration file, so that the file
/// is read once per frame size. Any thread.
class GeometrySource {
 public:
  /// The geometry of a stream whose caps have these fields and a fixed size. The error says what is
  /// missing and the ways to supply it, or what is wrong with the file.
  Result<StereoGeometry> geometry(const GstStructure* fields, const GeometryProperties& properties);
  /// Forgets the content of the file, which may change until the next start.
  void forget();
  /// What read_calibration() noted about the file; none without a file.
  std::vector<std::string> remarks();

 private:
  Result<StereoGeometry> from_file(const std::string& path, int width, int height);

  struct File {
    std::string path;
    int width = 0;
    int height = 0;
    Result<StereoGeometry> geometry;
    std::vector<std::string> remarks;
  };
  std::mutex mutex_;
  std::optional<File> file_;  ///< guarded by mutex_
};

/// The geometry of the library for a disparity map of this stream and this unit.
DepthGeometry depth_geometry(const StereoGeometry& stream, const MapUnit& unit);

}  // namespace mtstereo::plugin
