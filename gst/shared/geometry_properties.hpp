// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "mtstereo/geometry/depth.hpp"
#include "mtstereo/geometry/rectification.hpp"
#include "mtstereo/result.hpp"
#include "shared/map_unit.hpp"
#include "shared/properties.hpp"
#include "shared/stereo_geometry.hpp"

// The properties of elements that turn disparities into depths: mtdepth and mtcloud.

namespace mtstereo::plugin {

/// The blurb of disparity-scale of the elements downstream of mtstereo.
inline constexpr const char* kScaleBlurb =
    "Steps per px of the input if neither its caps nor its meta have a disparity-scale, for "
    "example downstream of a decoder; these take precedence";

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
  bool operator==(const GeometryProperties&) const = default;
};

inline constexpr double kLargestFocalLength = 1e6;  ///< [px]
inline constexpr double kLargestOffset = 1e5;       ///< [px]

/// The rows of an element whose values have a member `geometry`.
template <typename State>
std::vector<Property<State>> geometry_rows() {
  using Geometry = GeometryProperties;
  using Row = Property<State>;
  return {
      Row("focal-length", {&State::geometry, &Geometry::focal_length}, 0, kLargestFocalLength,
          "Focal length of the rectified views, in px (0: from the calibration or the caps)"),
      Row("baseline", {&State::geometry, &Geometry::baseline}, 0, kLongestBaseline,
          "Distance between the cameras, in meters (0: from the calibration or the caps)"),
      Row("principal-offset", {&State::geometry, &Geometry::principal_offset}, -kLargestOffset,
          kLargestOffset,
          "Column of the right principal point minus that of the left, in px, added to the "
          "disparities (not set: from the calibration or the caps, else 0)"),
      Row("principal-x", {&State::geometry, &Geometry::principal_x}, -kLargestOffset,
          kLargestOffset,
          "Column of the left principal point, in px (not set: from the calibration or the caps, "
          "else the center)"),
      Row("principal-y", {&State::geometry, &Geometry::principal_y}, -kLargestOffset,
          kLargestOffset,
          "Row of the left principal point, in px (not set: from the calibration or the caps, else "
          "the center)"),
      Row("calibration", {&State::geometry, &Geometry::calibration},
          "Calibration file of the cameras, if the caps do not have the geometry: the views were "
          "rectified with it and the defaults of mtrectify, or by the rectification that it "
          "states; two files are separated by a comma"),
      Row("disparity-scale", {&State::geometry, &Geometry::disparity_scale}, 1, 65535, kScaleBlurb),
  };
}

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
